// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/stage_store.h"

#include <gtest/gtest.h>
#include <filesystem>
#include <string>

#include "base/file_io.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

TEST(SketchKey, DependsOnTheOptionsOfGrowthThatChooseSeeds) {
  const Scene scene;
  Options options;
  const std::uint64_t key = SketchKey(scene, options);
  options.curve_growth.min_significance = 1;
  EXPECT_EQ(SketchKey(scene, options), key);
  options.curve_growth.max_crowding = 0;
  const std::uint64_t with_texture = SketchKey(scene, options);
  EXPECT_NE(with_texture, key);
  options.curve_growth.enabled = false;
  EXPECT_NE(SketchKey(scene, options), with_texture);
}

TEST(StageStore, KeepsNothingWithoutAFolder) {
  StageStore store{std::filesystem::path()};
  EXPECT_EQ(store.Save(kDetectEdges, 1, std::vector<EdgeMap>(2)), "");
  EXPECT_FALSE(store.has_saved());
  EXPECT_FALSE(std::filesystem::exists("edges.bin"));
  EXPECT_FALSE(store.Load(kDetectEdges, 1));
  store.Clean();
}

TEST(StageStore, CleansUpAfterAKilledRun) {
  const TemporaryFolder folder;
  folder.Write("stages/edges.bin", "");
  folder.Write("stages/sketch.bin.4711-0.tmp", "half");
  StageStore(folder.path() / "stages").Clean();
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "stages"));
}

TEST(StageStore, KeepsTheLogOfAnAdjustment) {
  const TemporaryFolder folder;
  const std::filesystem::path log =
      folder.Write(kAdjustmentLog, "Iteration 1\n");
  folder.Write("stages/adjustment.bin", "");
  StageStore store(folder.path() / "stages");
  store.KeepText(log);
  std::filesystem::remove(log);
  store.FetchText(log);
  EXPECT_EQ(ReadFile(log).value(), "Iteration 1\n");
  store.Clean();
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "stages"));
}

TEST(AdjustmentKey, DependsOnPixelsAndTheProgram) {
  Scene scene;
  scene.points.resize(1);
  scene.points[0].pixels = {{3, 4}};
  const std::uint64_t key = AdjustmentKey(scene, "/bin/true");
  EXPECT_EQ(AdjustmentKey(scene, "/bin/true"), key);
  EXPECT_NE(AdjustmentKey(scene, "/bin/false"), key);
  scene.points[0].pixels[0].x() += 1e-9;
  EXPECT_NE(AdjustmentKey(scene, "/bin/true"), key);
}

TEST(StageStore, LoadsNothingOfOtherImages) {
  const TemporaryFolder folder;
  constexpr std::uint64_t kImages = 5;
  StageStore store(folder.path(), kImages);
  EXPECT_EQ(store.Save(kDetectEdges, 1, std::vector<EdgeMap>(2)), "");
  EXPECT_TRUE(StageStore(folder.path(), kImages).Load(kDetectEdges, 1));
  EXPECT_FALSE(StageStore(folder.path(), kImages).Load(kDetectEdges, 2));
  EXPECT_FALSE(StageStore(folder.path(), kImages + 1).Load(kDetectEdges, 1));
  EXPECT_FALSE(StageStore(folder.path()).Load(kDetectEdges, 1));
}

TEST(StageStore, RemovesWhatAKilledRunLeftOfTheStageThatItSaves) {
  const TemporaryFolder folder;
  const std::filesystem::path left =
      folder.Write(std::string(kDetectEdges.file) + ".123-4.tmp", "half");
  const std::filesystem::path other =
      folder.Write(std::string(kSketchEdges.file) + ".123-4.tmp", "half");
  StageStore store(folder.path());
  EXPECT_EQ(store.Save(kDetectEdges, 1, std::vector<EdgeMap>(2)), "");
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(other));
  EXPECT_TRUE(store.Load(kDetectEdges, 1));
}

}  // namespace
}  // namespace curvix
