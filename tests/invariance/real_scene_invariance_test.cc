// SPDX-License-Identifier: BSD-3-Clause
// What must not change the curves of photographs.
#include <curvix/reconstruct.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <filesystem>
#include <string>

#include "base/file_io.h"
#include "colmap/workspace.h"
#include "io/stage_io.h"
#include "tests/invariance/compare_runs.h"
#include "tests/support/data_folder.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// Neighbouring photographs of a ring around a figure, with COLMAP's points.
class RealScene : public ::testing::Test {
 protected:
  void SetUp() override {
    const fs::path path = DataFolder() / "dino_ring";
    if (!fs::exists(path)) {
      GTEST_SKIP() << path << " is not there; set CURVIX_DATA to the folder of "
                   << "test data";
    }
    WorkspacePaths paths;
    paths.workspace_path = path;
    Result<ColmapModel> model =
        ReadColmapModel(FindWorkspace(paths)->model_path);
    ASSERT_TRUE(model.ok()) << model.status().message();
    constexpr std::size_t kNumViews = 6;
    model->images.resize(kNumViews);
    scene_ = SceneFromColmapModel(*model, path / "images");
    edge_maps_ = *DetectEdges(scene_, Options());
    expected_ = Run(scene_, 1);
    ASSERT_FALSE(expected_.curves.curves.empty());
  }

  Reconstruction Run(const Scene& scene, int num_threads) const {
    Options options;
    options.runtime.num_threads = num_threads;
    return *ReconstructCurves(scene, edge_maps_, options);
  }

  Scene scene_;
  std::vector<EdgeMap> edge_maps_;
  Reconstruction expected_;
};

TEST_F(RealScene, ThreadsMakeNoDifferenceToItsEdges) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "edges";
  const auto edges_in_bytes = [&](int num_threads) {
    Options options;
    options.runtime.num_threads = num_threads;
    EXPECT_TRUE(WriteStageResult(file, 0, *DetectEdges(scene_, options)).ok());
    return *ReadFile(file);
  };
  const std::string expected = edges_in_bytes(1);
  for (const int num_threads : {1, 2, 3, 8}) {
    EXPECT_TRUE(edges_in_bytes(num_threads) == expected) << num_threads;
  }
}

TEST_F(RealScene, ThreadsMakeNoDifference) {
  for (const int num_threads : {2, 3, 8}) {
    SCOPED_TRACE(num_threads);
    ExpectIdentical(Run(scene_, num_threads), expected_);
  }
}

TEST_F(RealScene, TheOrderOfViewsMakesNoDifference) {
  std::reverse(scene_.views.begin(), scene_.views.end());
  std::reverse(edge_maps_.begin(), edge_maps_.end());
  for (ScenePoint& point : scene_.points) {
    const int last = static_cast<int>(scene_.views.size()) - 1;
    for (int& view_idx : point.view_idxs) view_idx = last - view_idx;
    std::reverse(point.view_idxs.begin(), point.view_idxs.end());
  }
  ExpectSameSet(Run(scene_, 2).curves, expected_.curves, 1e-9);
}

// But for where optimisers stop: a thousandth of a pixel is 2e-7 there.
TEST_F(RealScene, TheWorldsFrameAndUnitMakeNoDifference) {
  Random random(5);
  const OtherWorld world{
      Eigen::Quaterniond(random.Rotation()), random.UnitVector(), 1000};
  const CurveSet back = world.Back(Run(world.Moved(scene_), 2).curves);
  ExpectSameSet(back, expected_.curves, 2e-7);
}

}  // namespace
}  // namespace curvix
