// SPDX-License-Identifier: BSD-3-Clause
// The installed COLMAP makes a model of synthetic photographs; the program
// refines its disturbed poses. Skipped where COLMAP is not installed.
#include <curvix/curve_io.h>
#include <sys/wait.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "base/median.h"
#include "geometry/similarity.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/commands/command_synthesize.h"
#include "plugin/poses/child_process.h"
#include "synthetic/synthetic_scene.h"
#include "tests/end_to_end/run_program.h"
#include "tests/plugin/posed_points.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// The exit code of `command`, run by a shell, and what it says.
int Execute(const std::string& command, std::string* said) {
  said->clear();
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) {
    *said += static_cast<char>(c);
  }
  const int status = pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class InstalledColmap : public testing::Test {
 protected:
  void SetUp() override {
    if (FindInPath("colmap").empty()) {
      GTEST_SKIP() << "COLMAP is not installed";
    }
    options_.num_views = 24;
    options_.width = 600;
    options_.height = 600;
    options_.texture = 200;
    const Status status = Synthesize(options_, folder_.path());
    ASSERT_TRUE(status.ok()) << status.message();
    const Result<ColmapModel> poses =
        ReadColmapModel(folder_.path() / "sparse/0");
    ASSERT_TRUE(poses.ok()) << poses.status().message();
    truth_ = *poses;
  }

  // The model of the photographs with COLMAP's points, true poses.
  void TriangulateByColmap() {
    fs::create_directories(folder_.path() / "true");
    // One thread: ids in the database in the order of the names, as ours are.
    Colmap(
        "feature_extractor --database_path db --image_path images "
        "--ImageReader.single_camera 1 --ImageReader.camera_model PINHOLE "
        "--SiftExtraction.use_gpu 0 --SiftExtraction.num_threads 1");
    Colmap("exhaustive_matcher --database_path db --SiftMatching.use_gpu 0");
    Colmap(
        "point_triangulator --database_path db --image_path images "
        "--input_path sparse/0 --output_path true");
    const Result<ColmapModel> truth = ReadColmapModel(folder_.path() / "true");
    ASSERT_TRUE(truth.ok()) << truth.status().message();
    ASSERT_GE(truth->points.size(), 200u);
    truth_ = *truth;
  }

  // Runs colmap in the folder of the test.
  std::string Colmap(const std::string& arguments) {
    std::string said;
    EXPECT_EQ(Execute("cd '" + folder_.path().string() +
                          "' && QT_QPA_PLATFORM=offscreen colmap " + arguments,
                      &said),
              0)
        << said;
    return said;
  }

  // Runs the program on the model in sparse/1, with few hypotheses and low
  // demands.
  int Curvix(const std::string& more, std::string* said) {
    const std::string folder = folder_.path().string();
    return Execute(std::string("'") + CURVIX_PROGRAM + "' --workspace_path '" +
                       folder + "' --input_path '" + folder +
                       "/sparse/1' --output_path '" + folder +
                       "/out' --EdgeDetection.min_gradient 60 "
                       "--Hypotheses.num_partners 1 "
                       "--CurveRefinement.max_dilution 0 " +
                       more,
                   said);
  }

  // The median distance of true places that views see from the curves of the
  // last run, made with `poses` and brought to the true cameras. World units.
  double CurveError(const std::vector<Rigid3>& poses) const {
    Result<CurveSet> curves = ReadCurves(folder_.path() / "out/curves.ply", {});
    const Result<SyntheticScene> scene = MakeSyntheticScene(options_);
    const auto to_truth = AlignPoses(poses, PosesOf(truth_));
    if (!curves.ok() || !scene.ok() || !to_truth) return 1e9;
    std::vector<Eigen::Vector3d> samples;
    for (const Curve& curve : curves->curves) {
      for (const CurveSample& sample : curve.samples) {
        samples.push_back(*to_truth * sample.position);
      }
    }
    std::vector<double> distances;
    for (std::size_t i = 0; i < scene->truth.size(); i += 3) {
      const TrueSample& place = scene->truth[i];
      if (place.num_views_edge < 8) continue;
      double least = 1e9;
      for (const Eigen::Vector3d& sample : samples) {
        const Eigen::Vector3d offset = sample - place.position;
        // Across the true curve: samples are some way apart along it.
        if (std::abs(offset.dot(place.tangent)) > 0.01) continue;
        least = std::min(least, offset.cross(place.tangent).norm());
      }
      distances.push_back(least);
    }
    return MedianOrNan(distances);
  }

  SyntheticOptions options_;
  TemporaryFolder folder_;
  ColmapModel truth_;
};

TEST_F(InstalledColmap, GivesCurvesAsGoodAsThoseOfTruePoses) {
  ASSERT_NO_FATAL_FAILURE(TriangulateByColmap());
  const fs::path input = folder_.path() / "sparse/1";
  std::string said;
  ASSERT_TRUE(WriteColmapModel(truth_, input).ok());
  ASSERT_EQ(Curvix("--refiner none --refine_poses_with_curves 0", &said), 0)
      << said;
  const double error_of_truth = CurveError(PosesOf(truth_));

  ColmapModel model = truth_;
  DisturbPoses(1, 5, &model);
  ASSERT_TRUE(WriteColmapModel(model, input).ok());
  ASSERT_EQ(Curvix("", &said), 0) << said;
  const Result<ColmapModel> refined =
      ReadColmapModel(folder_.path() / "out/sparse");
  ASSERT_TRUE(refined.ok()) << refined.status().message();
  EXPECT_LE(CurveError(PosesOf(*refined)), 1.1 * error_of_truth) << said;
  const auto left = AlignPoses(PosesOf(*refined), PosesOf(model));
  ASSERT_TRUE(left);
  // Curves keep the unit in which the disturbed poses show the structure. These
  // tell it to about a pixel of its radius, some 300 pixels; COLMAP's matches
  // differ from run to run.
  EXPECT_NEAR(left->scale, 1, 1. / 300);
}

TEST_F(InstalledColmap, GivesBetterPosesInTheSameWorld) {
  std::mt19937 random(1);
  AddPoints(400, 0.3, random, &truth_);
  ColmapModel model = truth_;
  DisturbPoses(1.5, 5, &model);
  const fs::path input = folder_.path() / "sparse/1";
  ASSERT_TRUE(WriteColmapModel(model, input).ok());
  const fs::path output = folder_.path() / "out";
  std::string said;
  const std::string by_points = "--refine_poses_with_curves 0 ";
  ASSERT_EQ(Curvix(by_points, &said), 0) << said;
  EXPECT_THAT(said, HasSubstr("Refine poses ... COLMAP "));

  std::ifstream file(output / "report.json");
  const auto report = nlohmann::json::parse(file)["pose_refinement"];
  EXPECT_TRUE(report["accepted"]) << report;
  EXPECT_LT(report["error_after"]["mean_px"], report["error_before"]["mean_px"])
      << report;
  EXPECT_TRUE(fs::exists(output / "bundle_adjuster.log"));

  const Result<ColmapModel> refined = ReadColmapModel(output / "sparse");
  ASSERT_TRUE(refined.ok()) << refined.status().message();
  EXPECT_THAT(Colmap("model_analyzer --path out/sparse"),
              HasSubstr(std::to_string(refined->points.size())));
  const auto left = AlignPoses(PosesOf(*refined), PosesOf(model));
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->scale, 1, 1e-6);
  EXPECT_LT(MedianShift(*refined, truth_), 0.3 * MedianShift(model, truth_));

  // Once is enough.
  const std::string poses = Read(output / "sparse/images.bin");
  ASSERT_EQ(Curvix(by_points, &said), 0) << said;
  EXPECT_THAT(said, HasSubstr("Refine poses ... COLMAP "));
  std::ifstream again(output / "report.json");
  EXPECT_THAT(nlohmann::json::parse(again)["run"]["resumed_stages"].dump(),
              HasSubstr("\"refine_poses\""));
  EXPECT_EQ(Read(output / "sparse/images.bin"), poses);
  EXPECT_TRUE(fs::exists(output / "bundle_adjuster.log"));

  const fs::path broken =
      folder_.Write("broken/colmap", "#!/bin/sh\necho Aborted\nexit 134\n");
  fs::permissions(broken, fs::perms::owner_all);
  EXPECT_EQ(
      Curvix(by_points + "--colmap_path '" + broken.string() + "'", &said), 0);
  EXPECT_THAT(said, HasSubstr("WARNING: Bundle adjustment is left out"));
  EXPECT_FALSE(fs::exists(output / "sparse"));  // of the run before
}

}  // namespace
}  // namespace curvix
