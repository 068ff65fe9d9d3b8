// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_search.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "geometry/directions.h"
#include "geometry/similarity.h"
#include "tests/support/wire_scene.h"

namespace curvix {
namespace {

// No place nor point of it.
constexpr std::size_t kUnobserved = 3;

bool GoOn(std::int64_t, std::int64_t) { return true; }

// Places and points stay where the views see them, and views that see none stay
// where they are.
TEST(PoseSearch, RestoresTheGaugeOfViewsPlacesAndPoints) {
  const WireScene wires = MakeWireScene(CubeAndCircle(), 14);
  const Options options;
  PoseSearch search(wires.scene, wires.edge_maps, options, GoOn);
  PoseObservationSet observations;
  observations.places = search.Sketch();
  search.FindEdges(&observations.places);
  for (CurvePlace& place : observations.places) {
    std::erase_if(place.support, [](const EdgeRef& ref) {
      return ref.view_idx == kUnobserved;
    });
  }
  search.Fit(&observations);
  ASSERT_GT(observations.places.size(), 100u);
  PointSample point;
  point.position = {0.1, 0.2, -0.1};
  for (int i = 0; i < 14; ++i) {
    if (i == kUnobserved) continue;
    const auto view_idx = static_cast<std::size_t>(i);
    const View& view = wires.scene.views[view_idx];
    point.observations.push_back({i,
                                  *Project(CameraOf(wires.scene, view),
                                           view.cam_from_world,
                                           point.position)});
  }
  observations.points = {point};
  const std::vector<Eigen::Vector3d> meant = PositionsOf(observations);

  // The same in another frame, in another unit.
  const Rigid3 motion = {RotationBy({2e-3, -3e-3, 1e-3}), {3e-3, 1e-3, -2e-3}};
  constexpr double kUnit = 1.002;
  MovedCameras moved = search.edges().moved();
  for (std::size_t i = 0; i < wires.scene.views.size(); ++i) {
    if (i == kUnobserved) continue;
    const Rigid3& pose = wires.scene.views[i].cam_from_world;
    Rigid3 other = pose * motion.Inverse();
    other.translation = kUnit * other.translation;
    moved.new_cam_from_cam[i] = other * pose.Inverse();
  }
  search.Move(moved);
  for (CurvePlace& place : observations.places) {
    OccludingContour& contour = place.contour;
    contour.axis.position = kUnit * (motion * contour.axis.position);
    contour.axis.tangent = motion.rotation * contour.axis.tangent;
    contour.outward = motion.rotation * contour.outward;
    contour.radius *= kUnit;
  }
  observations.points[0].position =
      kUnit * (motion * observations.points[0].position);

  search.RestoreGauge(&observations);
  const std::vector<Eigen::Vector3d> restored = PositionsOf(observations);
  ASSERT_EQ(restored.size(), meant.size());
  for (std::size_t i = 0; i < meant.size(); ++i) {
    EXPECT_LT((restored[i] - meant[i]).norm(), 1e-6) << i;
  }
  for (std::size_t i = 0; i < wires.scene.views.size(); ++i) {
    const Rigid3 increment = search.edges().moved().new_cam_from_cam[i];
    EXPECT_LT(increment.translation.norm(), 1e-6) << i;
    EXPECT_LT(increment.rotation.vec().norm(), 1e-6) << i;
  }
}

}  // namespace
}  // namespace curvix
