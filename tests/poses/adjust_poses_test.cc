// SPDX-License-Identifier: BSD-3-Clause
#include "poses/adjust_poses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

bool KeepGoing() { return true; }

// Places on the edges of a cube, and their exact edges in all views.
std::vector<PoseSample> ExactSamples(const std::vector<PosedView>& views) {
  std::vector<PoseSample> samples;
  for (const TestCurve& curve : CubeCurves()) {
    for (double s = 0.1; s < curve.length; s += 0.3) {
      PoseSample& sample = samples.emplace_back();
      sample.rim.axis = {curve.position(s), curve.tangent(s)};
      sample.rim.outward = sample.rim.axis.tangent.unitOrthogonal();
      for (std::size_t i = 0; i < views.size(); ++i) {
        sample.observations.push_back(
            {static_cast<std::int32_t>(i),
             *ProjectEdge(views[i], sample.rim.axis)});
      }
    }
  }
  return samples;
}

PosedView Moved(PosedView view, const Rigid3& motion) {
  view.rotation = motion.rotation.toRotationMatrix() * view.rotation;
  view.translation = motion * view.translation;
  view.center = -view.rotation.transpose() * view.translation;
  return view;
}

TEST(AdjustPoses, LeavesExactPosesAndPlacesAlone) {
  const std::vector<PosedView> views = RingOfViews(8);
  const std::vector<double> sigmas(views.size(), 0.2);
  const std::vector<PoseSample> samples = ExactSamples(views);
  const AdjustedPoses adjusted = AdjustPoses({views, sigmas, samples, 1},
                                             std::vector<Rigid3>(views.size()),
                                             1,
                                             KeepGoing);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_LT(adjusted.new_cam_from_cam[i].translation.norm(), 1e-6);
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_LT(
        (adjusted.rims[i].axis.position - samples[i].rim.axis.position).norm(),
        1e-6);
  }
}

// Upright cylinders, of which the rim is seen elsewhere from each camera.
TEST(AdjustPoses, IsNotMovedByRims) {
  const std::vector<PosedView> views = RingOfViews(24);
  const std::size_t num_seeing = 6;
  std::vector<PoseSample> samples;
  for (int i = 0; i < 20; ++i) {
    Rim body;
    body.axis = {{0.1 * i - 1, 0.3 * (i % 4), 0.05 * i},
                 Eigen::Vector3d::UnitZ()};
    body.radius = 0.2 + 0.02 * i;
    body.outward = Eigen::Vector3d::UnitY();
    PoseSample& sample = samples.emplace_back();
    for (std::size_t v = 0; v < num_seeing; ++v) {
      const SpaceEdge seen = SeenFrom(body, views[v].center);
      sample.observations.push_back(
          {static_cast<std::int32_t>(v), *ProjectEdge(views[v], seen)});
    }
    // Taken for an edge where one view sees it.
    sample.rim = body;
    sample.rim.axis = SeenFrom(body, views[2].center);
    sample.rim.radius = 0;
  }
  const std::vector<double> sigmas(views.size(), 0.2);
  const AdjustedPoses adjusted = AdjustPoses({views, sigmas, samples, 10},
                                             std::vector<Rigid3>(views.size()),
                                             1,
                                             KeepGoing);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_NEAR(
        adjusted.rims[i].radius, 0.2 + 0.02 * static_cast<double>(i), 0.02);
  }
  for (std::size_t v = 0; v < num_seeing; ++v) {
    EXPECT_LT(adjusted.new_cam_from_cam[v].translation.norm(), 0.003) << v;
  }
}

TEST(AdjustPoses, BringsAMovedCameraBack) {
  std::vector<PosedView> views = RingOfViews(8);
  const std::vector<PoseSample> samples = ExactSamples(views);
  Rigid3 motion;
  motion.rotation = Eigen::AngleAxisd(0.003, Eigen::Vector3d::UnitY());
  motion.translation = {0.01, -0.005, 0.02};
  views[3] = Moved(views[3], motion);
  const std::vector<double> sigmas(views.size(), 0.2);
  const AdjustedPoses adjusted = AdjustPoses({views, sigmas, samples, 3},
                                             std::vector<Rigid3>(views.size()),
                                             1,
                                             KeepGoing);
  // All cameras share the way back, which the places do not tell from one.
  const PosedView back = Moved(views[3], adjusted.new_cam_from_cam[3]);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto seen =
        ProjectEdge(back, SeenFrom(adjusted.rims[i], back.center));
    const ImageEdge& edge = samples[i].observations[3].edge;
    const Eigen::Vector2d offset = seen->position - edge.position;
    EXPECT_LT(
        std::abs(offset.x() * edge.tangent.y() - offset.y() * edge.tangent.x()),
        0.05);
  }
}

TEST(AdjustPoses, LeavesPosesAloneWithoutSamples) {
  const std::vector<PosedView> views = RingOfViews(3);
  const std::vector<double> sigmas(views.size(), 0.2);
  const std::vector<PoseSample> none;
  const std::vector<Rigid3> start(views.size());
  const AdjustedPoses adjusted =
      AdjustPoses({views, sigmas, none}, start, 1, KeepGoing);
  ASSERT_EQ(adjusted.new_cam_from_cam.size(), views.size());
  EXPECT_EQ(adjusted.new_cam_from_cam[1].translation, start[1].translation);
  EXPECT_TRUE(adjusted.rims.empty());
}

TEST(AdjustPoses, StopsWhenAsked) {
  std::vector<PosedView> views = RingOfViews(8);
  const std::vector<PoseSample> samples = ExactSamples(views);
  Rigid3 motion;
  motion.translation = {0.01, 0, 0};
  views[3] = Moved(views[3], motion);
  const std::vector<double> sigmas(views.size(), 0.2);
  const AdjustedPoses adjusted = AdjustPoses(
      {views, sigmas, samples, 3}, std::vector<Rigid3>(views.size()), 1, [] {
        return false;
      });
  EXPECT_EQ(adjusted.new_cam_from_cam[3].translation, Eigen::Vector3d::Zero());
}

TEST(AdjustPoses, LeavesAllAsItIsIfASampleIsBehindACamera) {
  const std::vector<PosedView> views = RingOfViews(8);
  std::vector<PoseSample> samples = ExactSamples(views);
  const Eigen::Vector3d behind =
      views[3].center - views[3].rotation.row(2).transpose();
  samples[5].rim.axis.position = behind;
  const std::vector<double> sigmas(views.size(), 0.2);
  const AdjustedPoses adjusted = AdjustPoses({views, sigmas, samples, 3},
                                             std::vector<Rigid3>(views.size()),
                                             1,
                                             KeepGoing);
  EXPECT_EQ(adjusted.new_cam_from_cam[3].translation, Eigen::Vector3d::Zero());
  EXPECT_EQ(adjusted.rims[5].axis.position, behind);
}

}  // namespace
}  // namespace curvix
