// SPDX-License-Identifier: BSD-3-Clause
#include "poses/posed_edges.h"

#include <curvix/refine_poses.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "geometry/lens.h"
#include "tests/support/wire_scene.h"

namespace curvix {
namespace {

class PosedEdgesTest : public testing::Test {
 protected:
  CurvePlace SeenByFirst(int num_views) const {
    CurvePlace place;
    for (int i = 0; i < num_views; ++i) place.support.push_back({i, 0});
    return place;
  }
  Eigen::Vector3d DirectionOf(std::size_t view_idx) const {
    return edges_.input_views()[view_idx].center.normalized();
  }

  const Options options_ = {};
  const WireScene wires_ = MakeWireScene(CubeAndCircle(), 50);
  const PosedEdges edges_{wires_.scene, wires_.edge_maps, options_};
};

TEST_F(PosedEdgesTest, AsksAllSupportersIfTheyAreFew) {
  const std::vector<std::size_t> views = edges_.QueryViews(SeenByFirst(8));
  EXPECT_TRUE(std::is_sorted(views.begin(), views.end()));
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_TRUE(std::binary_search(views.begin(), views.end(), i));
  }
  EXPECT_GT(views.size(), 8u);
}

TEST_F(PosedEdgesTest, AsksFortyAtMost) {
  const std::vector<std::size_t> views = edges_.QueryViews(SeenByFirst(35));
  EXPECT_EQ(views.size(), 40u);
  for (std::size_t i = 0; i < 35; ++i) {
    EXPECT_TRUE(std::binary_search(views.begin(), views.end(), i));
  }
}

// None is farther from those that are asked than the nearest two of these are
// from each other.
TEST_F(PosedEdgesTest, AsksFortyOfManyFromAllSides) {
  const std::vector<std::size_t> views = edges_.QueryViews(SeenByFirst(50));
  ASSERT_EQ(views.size(), 40u);
  EXPECT_TRUE(std::is_sorted(views.begin(), views.end()));
  double least = 2;
  for (const std::size_t i : views) {
    for (const std::size_t k : views) {
      if (i == k) continue;
      least = std::min(least, (DirectionOf(i) - DirectionOf(k)).norm());
    }
  }
  EXPECT_GT(least, 0);
  for (std::size_t i = 0; i < 50; ++i) {
    double distance = 2;
    for (const std::size_t k : views) {
      distance = std::min(distance, (DirectionOf(i) - DirectionOf(k)).norm());
    }
    EXPECT_LE(distance, least + 1e-9) << "view " << i;
  }
}

// The ideal image of a distorted camera reaches beyond its frame.
TEST_F(PosedEdgesTest, MoveToTheFramesOfNewCameras) {
  PosedEdges edges(wires_.scene, wires_.edge_maps, options_);
  MovedCameras moved = edges.moved();
  for (Camera& camera : moved.cameras) {
    camera = WithMoreTerms(camera);
    camera.params[4] = -0.1;
  }
  edges.Move(moved);
  for (const PosedView& view : edges.views()) EXPECT_GT(view.margin_px, 5);
}

TEST_F(PosedEdgesTest, AreCarriedToAtLeastAsManyCameras) {
  std::vector<Camera> cameras = wires_.scene.cameras;
  for (int i = 0; i < 2; ++i) {
    const auto carried =
        EdgesWithCameras(wires_.scene, wires_.edge_maps, cameras);
    ASSERT_TRUE(carried.ok()) << carried.status().message();
    EXPECT_EQ(carried->size(), wires_.edge_maps.size());
    cameras.push_back(cameras.back());
  }
  const Status status =
      EdgesWithCameras(wires_.scene, wires_.edge_maps, {}).status();
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  cameras.front().params.front() = -1;
  EXPECT_EQ(
      EdgesWithCameras(wires_.scene, wires_.edge_maps, cameras).status().code(),
      StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace curvix
