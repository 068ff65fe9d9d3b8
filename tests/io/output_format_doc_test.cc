// SPDX-License-Identifier: BSD-3-Clause
// docs/output_format.md shows what the writers write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "base/file_io.h"
#include "io/curve_formats.h"
#include "io/pcl_lines.h"
#include "tests/io/test_curves.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string Documentation() {
  const auto text =
      ReadFile(fs::path(CURVIX_SOURCE_DIR) / "docs" / "output_format.md");
  return text.ok() ? *text : "";
}

// An open curve, as the page has it in curves.txt.
CurveSet Example() {
  CurveSet set;
  set.curves.resize(1);
  for (const double x : {0.25, 0.5}) {
    CurveSample& sample = set.curves[0].samples.emplace_back();
    sample.position = {x, 0, 0};
    sample.sigma = 0.001;
    sample.kind = CurveKind::kMarking;
    sample.kind_probability = 0.8F;
    sample.support = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};
  }
  return set;
}

Scene ExampleScene() {
  Scene scene;
  for (std::uint32_t id = 1; id <= 4; ++id) {
    scene.views.emplace_back().image_id = id;
  }
  return scene;
}

// "float x y, uchar red" of fields in the order of a file.
class FieldList {
 public:
  void Add(const std::string& type, const std::string& name) {
    if (type != type_) text_ += (text_.empty() ? "" : ", ") + type;
    text_ += " " + name;
    type_ = type;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::string type_;
};

// "vertex: float x y z, uchar red\nedge: int vertex1 vertex2\n".
std::string PlyLayout(const std::string& bytes) {
  std::istringstream header(bytes.substr(0, bytes.find("end_header\n")));
  std::string text;
  FieldList fields;
  std::string name;
  const auto finish = [&] {
    if (!name.empty()) text += name + ": " + fields.text() + "\n";
    fields = {};
  };
  for (std::string line; std::getline(header, line);) {
    std::istringstream words(line);
    std::string keyword, first, second;
    words >> keyword >> first >> second;
    if (keyword == "property") fields.Add(first, second);
    if (keyword != "element") continue;
    finish();
    name = first;
  }
  finish();
  return text;
}

// "float x y z, uint rgb".
std::string PcdLayout(const std::string& bytes) {
  const auto line_after = [&](const std::string& keyword) {
    const std::size_t begin = bytes.find(keyword) + keyword.size();
    return std::istringstream(
        bytes.substr(begin, bytes.find('\n', begin) - begin));
  };
  std::istringstream names = line_after("\nFIELDS");
  std::istringstream types = line_after("\nTYPE");
  FieldList fields;
  for (std::string name, type; names >> name && types >> type;) {
    fields.Add(type == "F" ? "float" : "uint", name);
  }
  return fields.text();
}

TEST(OutputFormatPage, ShowsWhatTheWritersWrite) {
  const std::string page = Documentation();
  const CurveSet example = Example();
  EXPECT_THAT(page,
              HasSubstr("```\n" +
                        PlyLayout(EncodedCurves(EncodePlyLines, example, "")) +
                        "```\n"));
  EXPECT_THAT(page,
              HasSubstr("```\n" + PcdLayout(EncodedCurves(EncodePcd, example)) +
                        "\n```\n"));
  EXPECT_THAT(
      page, HasSubstr(EncodedCurves(EncodeTxtCurves, example, ExampleScene())));
  std::vector<Edge3d> edges;
  for (const CurveSample& sample : example.curves[0].samples) {
    edges.push_back({sample.position, sample.tangent, sample.support});
  }
  EXPECT_THAT(
      page,
      HasSubstr("```\n" + PlyLayout(Encoded(EncodePlyEdges, edges)) + "```\n"));
}

}  // namespace
}  // namespace curvix
