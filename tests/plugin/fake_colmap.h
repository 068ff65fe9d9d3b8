// SPDX-License-Identifier: BSD-3-Clause
// A program in the place of COLMAP.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "geometry/similarity.h"
#include "plugin/poses/pose_refinement.h"
#include "tests/plugin/posed_points.h"
#include "tests/support/temporary_folder.h"

namespace curvix {

inline bool GoOn(const std::string&, int, int) { return true; }

inline PoseRefinement Refine(const ColmapModel& model,
                             const PoseRefinementSettings& settings,
                             const std::filesystem::path& log_path = {}) {
  Result<PoseRefinement> result = RefinePoses(model, settings, log_path, GoOn);
  EXPECT_TRUE(result.ok()) << result.status().message();
  return result.ok() ? *std::move(result) : PoseRefinement();
}

// `model` after the similarity that brings its cameras to those of `truth`.
inline ColmapModel AlignedTo(const ColmapModel& truth, ColmapModel model) {
  const auto back = AlignPoses(PosesOf(model), PosesOf(truth));
  EXPECT_TRUE(back);
  for (ColmapImage& image : model.images) {
    image.cam_from_world = MovePose(*back, image.cam_from_world);
  }
  return model;
}

// A script in COLMAP's place. $4 is the input folder, $6 the output folder.
class FakeColmap : public testing::Test {
 protected:
  void SetUp() override { DisturbPoses(1, 5, &model_); }

  PoseRefinement Run(const std::string& bundle_adjuster,
                     const std::string& help = "echo 'COLMAP 3.8 -- SfM'") {
    const std::filesystem::path script =
        folder_.Write("bin/colmap",
                      "#!/bin/sh\nif [ \"$1\" = help -o \"$2\" = --help ]; "
                      "then\n" +
                          help + "\nexit 0\nfi\n" + bundle_adjuster + "\n");
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    settings_.colmap_path = script;
    settings_.refiner_timeout_s = 1;
    return Refine(model_, settings_, folder_.path() / "log");
  }

  // What the script printed.
  std::string Log() const {
    std::ifstream log(folder_.path() / "log");
    return {std::istreambuf_iterator<char>(log), {}};
  }

  // Writes `model` where the script can copy it from.
  std::string Copy(const ColmapModel& model, const std::string& name) {
    const std::filesystem::path folder = folder_.path() / name;
    const Status status = WriteColmapModel(model, folder);
    EXPECT_TRUE(status.ok()) << status.message();
    return "cp '" + folder.string() + "'/*.bin \"$5\"";
  }

  // What the adapter writes for COLMAP.
  ColmapModel Written() {
    Run("cp \"$3\"/*.bin '" + folder_.path().string() + "'");
    return ReadColmapModel(folder_.path()).value();
  }

  // The same with the poses of `truth`.
  ColmapModel WrittenWithPosesOf(ColmapModel truth) {
    ColmapModel model = Written();
    // It has ids in the order of the names.
    std::sort(truth.images.begin(),
              truth.images.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    for (std::size_t i = 0; i < model.images.size(); ++i) {
      model.images[i].cam_from_world = truth.images[i].cam_from_world;
    }
    return model;
  }

  // The run of a bundle adjuster that finds the poses of `truth`.
  PoseRefinement Solve(const ColmapModel& truth) {
    return Run(Copy(WrittenWithPosesOf(truth), "solved"));
  }

  static void ExpectKept(const PoseRefinement& result,
                         const std::string& reason,
                         const std::string& what = "is left out: ") {
    EXPECT_FALSE(result.model);
    EXPECT_FALSE(result.record.accepted);
    EXPECT_EQ(result.record.refiner, "colmap");
    EXPECT_THAT(result.record.reason, testing::HasSubstr(reason));
    EXPECT_THAT(result.notes,
                testing::ElementsAre(
                    testing::AllOf(testing::HasSubstr("Bundle adjustment"),
                                   testing::HasSubstr(what),
                                   testing::HasSubstr(reason))));
  }

  TemporaryFolder folder_;
  ColmapModel model_ = PosedPoints({});
  PoseRefinementSettings settings_;
};

}  // namespace curvix
