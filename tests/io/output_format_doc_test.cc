// SPDX-License-Identifier: BSD-3-Clause
// docs/output_format.md shows what the writers write.
#include <curvix/curve_io.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file_io.h"
#include "io/curve_formats.h"
#include "io/pcl_lines.h"
#include "io/ply_lines.h"
#include "tests/io/test_curves.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string Documentation() {
  const auto text =
      ReadFile(fs::path(CURVIX_SOURCE_DIR) / "docs" / "output_format.md");
  return text.ok() ? *text : "";
}

// The example of the page: a triangle and a segment.
CurveSet Example() {
  CurveSet set;
  set.curves.resize(2);
  set.curves[0].closed = true;
  for (const Eigen::Vector3d& position :
       {Eigen::Vector3d(0, 0, 1), {2, 0, 1}, {0, 1.5, 1}}) {
    CurveSample& sample = set.curves[0].samples.emplace_back();
    sample.position = position;
    sample.tangent = {0.6, 0.8, 0};
    sample.sigma = 0.004;
    sample.kind = CurveKind::kCrease;
    sample.kind_probability = 0.9F;
    sample.support = {{0, 11}, {1, 7}, {2, 30}, {3, 2}};
  }
  for (const double x : {0.25, 0.5}) {
    CurveSample& sample = set.curves[1].samples.emplace_back();
    sample.position = {x, 0, 0};
    sample.sigma = 0.001;
    sample.kind = CurveKind::kMarking;
    sample.kind_probability = 0.8F;
    sample.support = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}};
  }
  return set;
}

Scene ExampleScene() {
  Scene scene;
  for (std::uint32_t id = 1; id <= 6; ++id) {
    scene.views.emplace_back().image_id = id;
  }
  return scene;
}

std::string HeaderOf(const std::string& bytes, const std::string& last_line) {
  return bytes.substr(0, bytes.find(last_line) + last_line.size());
}

// A Python with NumPy; empty if there is none.
std::string FindPython() {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const std::string probe =
        std::string(python) + " -c 'import numpy' 2>/dev/null";
    if (std::system(probe.c_str()) == 0) return python;
  }
  return "";
}

TEST(OutputFormatPage, ShowsWhatTheWritersWrite) {
  const std::string page = Documentation();
  const CurveSet example = Example();
  EXPECT_THAT(page,
              HasSubstr(HeaderOf(EncodedCurves(EncodePlyLines, example),
                                 "end_header\n")));
  const std::string pcd = EncodedCurves(EncodePcd, example);
  const std::size_t fields = pcd.find("FIELDS");
  EXPECT_THAT(page, HasSubstr(pcd.substr(fields, pcd.find("TYPE") - fields)));
  EXPECT_THAT(page, HasSubstr(EncodedCurves(EncodeObjLines, example)));
  EXPECT_THAT(
      page, HasSubstr(EncodedCurves(EncodeTxtCurves, example, ExampleScene())));
  std::vector<Edge3d> edges;
  for (const CurveSample& sample : example.curves[0].samples) {
    edges.push_back({sample.position, sample.tangent, sample.support});
  }
  EXPECT_THAT(
      page,
      HasSubstr(HeaderOf(Encoded(EncodePlyEdges, edges), "end_header\n")));
}

TEST(OutputFormatPage, NumPyReadsThePlyAsThePageSays) {
  const std::string python = FindPython();
  if (python.empty()) GTEST_SKIP() << "no python3 with numpy";
  const std::string page = Documentation();
  const std::string fence = "```python\n";
  const std::size_t begin = page.find(fence) + fence.size();
  ASSERT_LT(begin, page.size());
  const TemporaryFolder folder;
  folder.Write("read.py", page.substr(begin, page.find("```", begin) - begin));
  ASSERT_TRUE(WriteCurves(folder.path() / "curves.ply", Example(), {}).ok());
  const std::string command = "cd " + folder.path().string() + " && " + python +
                              " read.py > printed.txt 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(*ReadFile(folder.path() / "printed.txt"),
            "0 closed 3 samples, length 6.000\n"
            "1 open 2 samples, length 0.250\n");
}

}  // namespace
}  // namespace curvix
