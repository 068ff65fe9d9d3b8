// SPDX-License-Identifier: BSD-3-Clause
// The examples, as a person runs them.
#include <curvix/curve_io.h>
#include <filesystem>
#include <regex>
#include <string>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/commands/command_synthesize.h"
#include "tests/end_to_end/run_program.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// With what it says to stderr.
Outcome RunAll(const std::string& command) {
  return RunInShell("{ " + command + "; } 2>&1");
}

// The number after `name` in `text`.
double NumberAfter(const std::string& name, const std::string& text) {
  std::smatch match;
  const std::regex pattern(name + R"(\s*(-?[0-9.]+))");
  return std::regex_search(text, match, pattern) ? std::stod(match[1]) : -1;
}

Curve Polyline(bool closed, const std::vector<Eigen::Vector3d>& positions) {
  Curve curve;
  curve.closed = closed;
  for (const Eigen::Vector3d& position : positions) {
    CurveSample sample;
    sample.position = position;
    curve.samples.push_back(sample);
  }
  return curve;
}

TEST(CurvesFromMyEdges, FindsTheHelix) {
  const TemporaryFolder folder;
  const Outcome outcome =
      RunAll("cd '" + folder.path().string() + "' && " + CURVIX_EXAMPLE_EDGES);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const double truth = NumberAfter("truth:", outcome.output);
  EXPECT_GT(truth, 9);
  EXPECT_NEAR(NumberAfter("length:", outcome.output), truth, 0.01 * truth)
      << outcome.output;
  const auto read = ReadCurves(folder.path() / "helix.ply", {});
  ASSERT_TRUE(read.ok()) << read.status().message();
  for (const Curve& curve : read->curves) {
    for (const CurveSample& sample : curve.samples) {
      EXPECT_NEAR(sample.position.head<2>().norm(), 1, 0.02);
    }
  }
}

TEST(MeasureCurves, TellsLengthAndDirection) {
  const TemporaryFolder folder;
  CurveSet set;
  set.curves = {Polyline(false, {{0, 0, 1}, {0, 0, 2}, {0, 0, 4}}),
                Polyline(true, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})};
  const fs::path path = folder.path() / "curves.txt";
  ASSERT_TRUE(WriteCurves(path, set, {}).ok());
  const Outcome outcome =
      RunAll(std::string(CURVIX_EXAMPLE_MEASURE) + " '" + path.string() + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              testing::ContainsRegex(
                  " 0 +no +3 +3\\.0000 +\\( *-?0\\.000 +-?0\\.000 +-?1\\.000\\)"
                  " +0\\.0000"));
  EXPECT_THAT(outcome.output, testing::ContainsRegex(" 1 +yes +4 +4\\.0000 "));
}

TEST(MeasureCurves, NamesAFileThatIsNotThere) {
  const Outcome outcome =
      RunAll(std::string(CURVIX_EXAMPLE_MEASURE) + " no_such_file.txt");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("no_such_file.txt"));
}

TEST(CurvesFromWorkspace, ShowsWhatTheCommandLeavesBehind) {
  const TemporaryFolder folder;
  SyntheticOptions options;
  options.solid = SyntheticSolid::kBlock;
  options.num_views = 12;
  options.width = options.height = 160;
  const fs::path workspace = folder.path() / "my proj";
  ASSERT_TRUE(Synthesize(options, workspace).ok());
  const Outcome outcome =
      RunAll("COLMAP_CURVIX='" CURVIX_PROGRAM "' '" CURVIX_SOURCE_DIR
             "/examples/01_curves_from_workspace.sh' '" +
             workspace.string() + "' --num_threads 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* name : {"curves.ply", "curves.txt", "report.json"}) {
    EXPECT_THAT(outcome.output, HasSubstr("curvix/0/" + std::string(name)));
  }
}

TEST(CurvesFromWorkspace, FindsTheResultsOfADenseModel) {
  const TemporaryFolder folder;
  SyntheticOptions options;
  options.solid = SyntheticSolid::kBlock;
  options.num_views = 12;
  options.width = options.height = 160;
  const fs::path dense = folder.path() / "proj/dense/0";
  ASSERT_TRUE(Synthesize(options, folder.path() / "block").ok());
  fs::create_directories(dense);
  fs::rename(folder.path() / "block/images", dense / "images");
  fs::rename(folder.path() / "block/sparse/0", dense / "sparse");
  const Outcome outcome =
      RunAll("COLMAP_CURVIX='" CURVIX_PROGRAM "' '" CURVIX_SOURCE_DIR
             "/examples/01_curves_from_workspace.sh' '" +
             (folder.path() / "proj").string() +
             "' --num_threads 1 --output_formats ply");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("bytes  " + dense.string()));
}

TEST(CurvesFromWorkspace, FailsAsTheProgramFails) {
  const Outcome outcome =
      RunAll("COLMAP_CURVIX='" CURVIX_PROGRAM "' '" CURVIX_SOURCE_DIR
             "/examples/01_curves_from_workspace.sh' /no/such/folder");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
}

}  // namespace
}  // namespace curvix
