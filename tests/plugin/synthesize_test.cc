// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/commands/command_synthesize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <csignal>
#include <filesystem>
#include <set>

#include "base/file_io.h"
#include "colmap/colmap_model.h"
#include "evaluation/ground_truth.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

SyntheticOptions SmallOptions() {
  SyntheticOptions options;
  options.num_views = 3;
  options.width = 80;
  options.height = 60;
  options.camera_model = CameraModel::kSimpleRadial;
  options.distortion = 0.1;
  return options;
}

// Bytes 16 to 23 of a PNG file: width and height, big endian.
int PngNumber(const std::string& png, std::size_t offset) {
  int number = 0;
  for (std::size_t i = offset; i < offset + 4; ++i) {
    number = 256 * number + static_cast<unsigned char>(png.at(i));
  }
  return number;
}

TEST(SynthesizeTest, WritesAWorkspaceThatReadsBackExactly) {
  const TemporaryFolder folder;
  const auto workspace = folder.path() / "new" / "workspace";
  const Status status = Synthesize(SmallOptions(), workspace);
  ASSERT_TRUE(status.ok()) << status.message();
  const SyntheticScene scene = *MakeSyntheticScene(SmallOptions());

  const Result<ColmapModel> model = ReadColmapModel(workspace / "sparse" / "0");
  ASSERT_TRUE(model.ok()) << model.status().message();
  ASSERT_EQ(model->images.size(), 3u);
  EXPECT_EQ(model->cameras[0].camera.params, scene.scene.cameras[0].params);
  for (std::size_t i = 0; i < 3; ++i) {
    const View& view = scene.scene.views[i];
    EXPECT_EQ(model->images[i].name, view.name);
    EXPECT_TRUE(model->images[i].cam_from_world.rotation.isApprox(
        view.cam_from_world.rotation, 1e-14));
    EXPECT_EQ(model->images[i].cam_from_world.translation,
              view.cam_from_world.translation);
    const Result<std::string> png = ReadFile(workspace / "images" / view.name);
    ASSERT_TRUE(png.ok()) << png.status().message();
    EXPECT_EQ(PngNumber(*png, 16), 80);
    EXPECT_EQ(PngNumber(*png, 20), 60);
  }

  const Result<GroundTruth> truth = ReadGroundTruth(workspace / "gt.txt");
  ASSERT_TRUE(truth.ok()) << truth.status().message();
  ASSERT_EQ(truth->samples.size(), scene.truth.size());
  for (std::size_t i = 0; i < scene.truth.size(); ++i) {
    EXPECT_EQ(truth->samples[i].position, scene.truth[i].position);
    EXPECT_EQ(truth->samples[i].curve_id, scene.truth[i].curve_id);
    EXPECT_EQ(truth->samples[i].num_views_edge, scene.truth[i].num_views_edge);
  }
}

TEST(SynthesizeTest, TheTruthKeepsItsKinds) {
  const TemporaryFolder folder;
  SyntheticOptions options = SmallOptions();
  options.solid = SyntheticSolid::kTable;
  options.pattern = SurfacePattern::kMixed;
  options.shadows = true;
  ASSERT_TRUE(Synthesize(options, folder.path()).ok());
  const SyntheticScene scene = *MakeSyntheticScene(options);
  const Result<GroundTruth> truth = ReadGroundTruth(folder.path() / "gt.txt");
  ASSERT_TRUE(truth.ok()) << truth.status().message();
  EXPECT_TRUE(truth->has_kinds);
  ASSERT_EQ(truth->samples.size(), scene.truth.size());
  std::set<CurveKind> kinds;
  for (std::size_t i = 0; i < scene.truth.size(); ++i) {
    EXPECT_EQ(truth->samples[i].kind, scene.truth[i].kind);
    kinds.insert(scene.truth[i].kind);
  }
  EXPECT_THAT(
      kinds,
      UnorderedElementsAre(
          CurveKind::kCrease, CurveKind::kBoundary, CurveKind::kMarking));
}

TEST(SynthesizeTest, RefusesToOverwriteAndSaysWhat) {
  const TemporaryFolder folder;
  const auto photo = folder.Write("images/mine.png", "photo");
  const Status status = Synthesize(SmallOptions(), folder.path());
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_THAT(status.message(), HasSubstr((folder.path() / "images").string()));
  EXPECT_EQ(*ReadFile(photo), "photo");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "sparse"));
}

TEST(SynthesizeTest, TakesAWorkspaceWithEmptyFolders) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "images");
  std::filesystem::create_directories(folder.path() / "sparse");
  EXPECT_TRUE(Synthesize(SmallOptions(), folder.path()).ok());
}

// Interrupted before each view in turn, while they are made and written.
TEST(SynthesizeTest, WritesNothingWhenItIsInterrupted) {
  for (const int calls : {0, 1, 2, 4}) {
    const TemporaryFolder folder;
    int left = calls;
    SyntheticOptions options = SmallOptions();
    options.num_threads = 1;
    options.points_per_view = calls == 0 ? 10000 : 0;
    const auto workspace = folder.path() / "new";
    const Status status =
        Synthesize(options, workspace, [&] { return left-- > 0; });
    EXPECT_EQ(status.code(), StatusCode::kCancelled) << calls;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

// As on a full disk: the last file, the longest, does not fit.
TEST(SynthesizeTest, LeavesNothingWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {50000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Status status = Synthesize(SmallOptions(), folder.path());
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_THAT(status.message(), HasSubstr("gt.txt"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_TRUE(Synthesize(SmallOptions(), folder.path()).ok());
}

TEST(SynthesizeTest, WritesNothingWhenAnOptionIsWrong) {
  const TemporaryFolder folder;
  SyntheticOptions options = SmallOptions();
  options.num_views = 1;
  const Status status = Synthesize(options, folder.path());
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace curvix
