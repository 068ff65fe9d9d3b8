// SPDX-License-Identifier: BSD-3-Clause
// Results against images held out: with which cameras, and in which frame.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "colmap/colmap_model.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/export/alignment_file.h"
#include "tests/end_to_end/block_test.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class Evaluate : public BlockTest {
 protected:
  json Holdout(const std::string& file, const std::string& more = "") {
    const Outcome outcome =
        Run("evaluate --json --holdout_every 4 --curves_path " +
            Quoted(results_ / file) + " " + more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return json::parse(outcome.output.substr(outcome.output.find('{')));
  }
  // As bundle adjustment leaves it: the cameras of the curves beside these, and
  // others in the workspace.
  void MoveCamerasOfWorkspace() {
    const fs::path given = workspace_ / "sparse/0";
    const fs::path refined = results_ / "sparse";
    ColmapModel model = *ReadColmapModel(fs::exists(refined) ? refined : given);
    fs::remove_all(refined);
    ASSERT_TRUE(WriteColmapModel(model, refined).ok());
    for (ColmapImage& image : model.images) {
      image.cam_from_world.translation.x() += 0.05;
    }
    fs::remove_all(given);
    ASSERT_TRUE(WriteColmapModel(model, given).ok());
  }
};

TEST_F(Evaluate, ResultsAreComparedWithTheCamerasBesideThem) {
  MoveCamerasOfWorkspace();
  const json refined = Holdout("curves.ply");
  EXPECT_EQ(refined["model"], (results_ / "sparse").string());
  EXPECT_GT(refined["precision"], 50);
  const fs::path given = workspace_ / "sparse/0";
  const json moved = Holdout("curves.ply", "--input_path " + Quoted(given));
  EXPECT_EQ(moved["model"], given.string());
  EXPECT_LT(moved["precision"], 30);
}

TEST_F(Evaluate, ResultsAreComparedInTheirFrame) {
  const json before = Holdout("curves.ply");
  EXPECT_EQ(before["alignment"], "");
  WorldAlignment alignment;
  alignment.has_scale = true;
  alignment.world_from_model.scale = 1000;
  const fs::path file = folder_.Write("proj/curvix/0/alignment.json",
                                      AlignmentJson(alignment).dump());
  ASSERT_EQ(Run("--output_formats ply,colmap").exit_code, 0);
  const json after = Holdout("curves.ply");
  EXPECT_EQ(after["alignment"], file.string());
  EXPECT_GT(after["length"], 100 * before["length"].get<double>());
  EXPECT_NEAR(after["precision"], before["precision"], 1);
  // Its cameras are in this frame, too.
  const fs::path model = results_ / "curves_model";
  const json same = Holdout("curves.ply", "--input_path " + Quoted(model));
  EXPECT_EQ(same["model"], model.string());
  EXPECT_EQ(same["alignment"], file.string());
  EXPECT_NEAR(same["precision"], before["precision"], 1);
}

// A newer alignment.json is not theirs yet.
TEST_F(Evaluate, CurvesKeepTheFrameInWhichTheyWereWritten) {
  WorldAlignment alignment;
  alignment.has_scale = true;
  const auto write = [&](double scale) {
    alignment.world_from_model.scale = scale;
    folder_.Write("proj/curvix/0/alignment.json",
                  AlignmentJson(alignment).dump());
  };
  write(1000);
  ASSERT_EQ(Run("").exit_code, 0);
  const json before = Holdout("curves.ply");
  write(7);
  const json after = Holdout("curves.ply");
  EXPECT_EQ(after["precision"], before["precision"]);
  EXPECT_EQ(after["length"], before["length"]);
}

TEST_F(Evaluate, KnownCurvesHaveToBeInTheFrameOfTheCurves) {
  const std::string known = "evaluate --truth_path " +
                            Quoted(workspace_ / "gt.txt") + " --curves_path " +
                            Quoted(results_ / "curves.obj");
  constexpr char kNote[] = "so must be the known ones";
  const Outcome before = RunProgram(known);
  EXPECT_THAT(before.output, testing::Not(HasSubstr(kNote)));
  EXPECT_THAT(before.output, testing::ContainsRegex("right kind +-"));
  ASSERT_EQ(Run("align --axes auto").exit_code, 0);
  EXPECT_THAT(RunProgram(known).output, HasSubstr(kNote));
}

TEST_F(Evaluate, RunsTellWhichFilesLoseDigitsOfLargeCoordinates) {
  constexpr char kNote[] = "Coordinates are large";
  EXPECT_THAT(Run("--refiner none").output, testing::Not(HasSubstr(kNote)));
  const fs::path given = workspace_ / "sparse/0";
  ColmapModel model = *ReadColmapModel(given);
  const Eigen::Vector3d shift(500000, 5600000, 0);
  for (ColmapImage& image : model.images) {
    Rigid3& pose = image.cam_from_world;
    pose.translation -= pose.rotation * shift;
  }
  for (ColmapPoint3D& point : model.points) point.position += shift;
  fs::remove_all(given);
  ASSERT_TRUE(WriteColmapModel(model, given).ok());
  EXPECT_THAT(Run("--refiner none").output, HasSubstr(kNote));
}

TEST_F(Evaluate, AWorkspaceHasTheCurvesToCompareWithKnownOnes) {
  const std::string known =
      "evaluate --json --truth_path " + Quoted(workspace_ / "gt.txt");
  const std::string given =
      known + " --curves_path " + Quoted(results_ / "curves.txt");
  const Outcome of_file = RunProgram(given);
  ASSERT_EQ(of_file.exit_code, 0) << of_file.output;
  EXPECT_EQ(Run(known).output, of_file.output);
  EXPECT_EQ(
      RunProgram(known + " --project_path " + Quoted(results_ / "project.ini"))
          .output,
      of_file.output);
  // Curves that are given come before those of the workspace.
  fs::rename(results_ / "curves.txt", folder_.path() / "curves.txt");
  EXPECT_EQ(
      Run(known + " --curves_path " + Quoted(folder_.path() / "curves.txt"))
          .output,
      of_file.output);
  fs::remove(results_ / "curves.obj");
  fs::remove(results_ / "curves.ply");
  ExpectError(known, "or curves.ply in " + results_.string());
}

TEST_F(Evaluate, WithoutImagesOfCurvesNothingIsExpected) {
  EXPECT_GT(Holdout("curves.txt")["expected_precision"], 0);
  EXPECT_FALSE(Holdout("curves.obj").contains("expected_precision"));
  const Outcome outcome = Run("evaluate --holdout_every 4 --curves_path " +
                              Quoted(results_ / "curves.ply"));
  EXPECT_THAT(outcome.output,
              HasSubstr("the same where they should be seen              -"));
  EXPECT_THAT(outcome.output, HasSubstr("\nmodel "));
}

}  // namespace
}  // namespace curvix
