// SPDX-License-Identifier: BSD-3-Clause
#include "poses/adjust_poses.h"

#include <curvix/scene.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "geometry/directions.h"
#include "tests/support/random.h"
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
      sample.contour.axis = {curve.position(s), curve.tangent(s)};
      sample.contour.outward = sample.contour.axis.tangent.unitOrthogonal();
      for (std::size_t i = 0; i < views.size(); ++i) {
        sample.observations.push_back(
            {static_cast<std::int32_t>(i),
             *ProjectEdge(views[i], sample.contour.axis)});
      }
    }
  }
  return samples;
}

// Without lenses and points, with edges 0.2 px about their curves.
AdjustedPoses Adjust(const Scene& scene,
                     const std::vector<PoseSample>& samples,
                     double prior_px,
                     const std::function<bool()>& keep_going = KeepGoing) {
  const std::vector<double> sigmas(scene.views.size(), 0.2);
  return AdjustPoses({scene, samples, {}, sigmas, 1, prior_px},
                     {std::vector<Rigid3>(scene.views.size()), scene.cameras},
                     1,
                     keep_going);
}

PosedView Moved(PosedView view, const Rigid3& increment) {
  view.rotation = increment.rotation.toRotationMatrix() * view.rotation;
  view.translation = increment * view.translation;
  view.center = -view.rotation.transpose() * view.translation;
  return view;
}

TEST(AdjustPoses, LeavesExactPosesAndPlacesAlone) {
  const std::vector<PosedView> views = RingOfViews(8);
  const std::vector<PoseSample> samples = ExactSamples(views);
  const AdjustedPoses adjusted = Adjust(SceneOf(views), samples, 1);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_LT(adjusted.moved.new_cam_from_cam[i].translation.norm(), 1e-6);
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_LT(
        (adjusted.contours[i].axis.position - samples[i].contour.axis.position)
            .norm(),
        1e-6);
  }
}

// Upright cylinders, of which the contour is seen elsewhere from each camera.
TEST(AdjustPoses, IsNotMovedByRims) {
  const std::vector<PosedView> views = RingOfViews(24);
  const std::size_t num_seeing = 6;
  std::vector<PoseSample> samples;
  for (int i = 0; i < 20; ++i) {
    OccludingContour body;
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
    sample.contour = body;
    sample.contour.axis = SeenFrom(body, views[2].center);
    sample.contour.radius = 0;
  }
  const AdjustedPoses adjusted = Adjust(SceneOf(views), samples, 10);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_NEAR(
        adjusted.contours[i].radius, 0.2 + 0.02 * static_cast<double>(i), 0.02);
  }
  for (std::size_t v = 0; v < num_seeing; ++v) {
    EXPECT_LT(adjusted.moved.new_cam_from_cam[v].translation.norm(), 0.003)
        << v;
  }
}

TEST(AdjustPoses, BringsAMovedCameraBack) {
  std::vector<PosedView> views = RingOfViews(8);
  const std::vector<PoseSample> samples = ExactSamples(views);
  Rigid3 increment;
  increment.rotation = Eigen::AngleAxisd(0.003, Eigen::Vector3d::UnitY());
  increment.translation = {0.01, -0.005, 0.02};
  views[3] = Moved(views[3], increment);
  const AdjustedPoses adjusted = Adjust(SceneOf(views), samples, 3);
  // All cameras share the way back, which the places do not tell from one.
  const PosedView back = Moved(views[3], adjusted.moved.new_cam_from_cam[3]);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto seen =
        ProjectEdge(back, SeenFrom(adjusted.contours[i], back.center));
    const ImageEdge& edge = samples[i].observations[3].edge;
    const Eigen::Vector2d offset = seen->position - edge.position;
    EXPECT_LT(
        std::abs(offset.x() * edge.tangent.y() - offset.y() * edge.tangent.x()),
        0.05);
  }
}

TEST(AdjustPoses, LeavesPosesAloneWithoutSamples) {
  const std::vector<PosedView> views = RingOfViews(3);
  const std::vector<Rigid3> start(views.size());
  const AdjustedPoses adjusted = Adjust(SceneOf(views), {}, 10);
  ASSERT_EQ(adjusted.moved.new_cam_from_cam.size(), views.size());
  EXPECT_EQ(adjusted.moved.new_cam_from_cam[1].translation,
            start[1].translation);
  EXPECT_TRUE(adjusted.contours.empty());
}

TEST(AdjustPoses, StopsWhenAsked) {
  std::vector<PosedView> views = RingOfViews(8);
  const std::vector<PoseSample> samples = ExactSamples(views);
  Rigid3 increment;
  increment.translation = {0.01, 0, 0};
  views[3] = Moved(views[3], increment);
  const AdjustedPoses adjusted =
      Adjust(SceneOf(views), samples, 3, [] { return false; });
  EXPECT_EQ(adjusted.moved.new_cam_from_cam[3].translation,
            Eigen::Vector3d::Zero());
}

TEST(AdjustPoses, LeavesOutSamplesBehindACamera) {
  std::vector<PosedView> views = RingOfViews(8);
  std::vector<PoseSample> samples = ExactSamples(views);
  Rigid3 increment;
  increment.translation = {0.01, 0, 0};
  views[3] = Moved(views[3], increment);
  PoseSample behind = samples[5];
  behind.contour.axis.position =
      views[3].center - views[3].rotation.row(2).transpose();
  const AdjustedPoses without = Adjust(SceneOf(views), samples, 3);
  samples.push_back(behind);
  const AdjustedPoses with = Adjust(SceneOf(views), samples, 3);
  EXPECT_NE(with.moved.new_cam_from_cam[3].translation,
            Eigen::Vector3d::Zero());
  EXPECT_EQ(with.moved.new_cam_from_cam[3].translation,
            without.moved.new_cam_from_cam[3].translation);
  EXPECT_EQ(with.contours.back().axis.position, behind.contour.axis.position);
  EXPECT_TRUE(std::isinf(with.costs.back()));
  EXPECT_EQ(with.costs[5], without.costs[5]);
}

// Random points before a ring of views that share a camera, and their pixels.
// Every other view is turned about its axis by 90 degrees: if all are upright,
// another ratio of focal lengths is a stretch of the world.
struct PointScene {
  Scene scene;
  std::vector<PointSample> points;
};

PointScene PointsSeenBy(const Camera& camera) {
  PointScene made;
  made.scene = SceneOf(RingOfViews(12));
  made.scene.cameras = {camera};
  for (std::size_t v = 0; v < made.scene.views.size(); ++v) {
    View& view = made.scene.views[v];
    view.camera_idx = 0;
    const Rigid3 turn{
        RotationBy((v % 2 == 0 ? 0 : kPi / 2) * Eigen::Vector3d::UnitZ()),
        Eigen::Vector3d::Zero()};
    view.cam_from_world = turn * view.cam_from_world;
  }
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    PointSample& point = made.points.emplace_back();
    point.position = 0.6 * random.NormalVector();
    for (std::size_t v = 0; v < made.scene.views.size(); ++v) {
      const auto pixel =
          Project(camera, made.scene.views[v].cam_from_world, point.position);
      if (pixel) {
        point.observations.push_back({static_cast<std::int32_t>(v), *pixel});
      }
    }
  }
  return made;
}

TEST(AdjustPoses, FindsTheLensFromPoints) {
  const PosedView view = RingOfViews(1).front();
  const double f = view.calibration(0, 0);
  const Eigen::Vector2d center = view.calibration.topRightCorner<2, 1>();
  const Camera truth{CameraModel::kRadial,
                     view.width,
                     view.height,
                     {f, center.x() + 3, center.y() - 2, -0.05, 0.01}};
  PointScene made = PointsSeenBy(truth);
  made.scene.cameras = {{CameraModel::kRadial,
                         view.width,
                         view.height,
                         {1.003 * f, center.x(), center.y(), -0.045, 0}}};
  const std::vector<double> sigmas(made.scene.views.size(), 0.2);
  MovedCameras moved{std::vector<Rigid3>(made.scene.views.size()),
                     made.scene.cameras};
  for (int i = 0; i < 10; ++i) {
    const AdjustedPoses adjusted =
        AdjustPoses({made.scene, {}, made.points, sigmas, 0.2, 50, {true}},
                    moved,
                    2,
                    KeepGoing);
    moved = adjusted.moved;
    for (std::size_t k = 0; k < made.points.size(); ++k) {
      made.points[k].position = adjusted.points[k];
    }
  }
  const std::vector<double>& params = moved.cameras[0].params;
  EXPECT_NEAR(params[0], f, 1e-3 * f);
  EXPECT_NEAR(params[1], truth.params[1], 0.3);
  EXPECT_NEAR(params[2], truth.params[2], 0.3);
  EXPECT_NEAR(params[3], truth.params[3], 2e-3);
  EXPECT_NEAR(params[4], truth.params[4], 5e-3);
}

// The ratio of focal lengths that AdjustPoses() finds, starting at 1, if it is
// 1.01 in fact.
double RatioFoundFrom(std::size_t num_points, double sigma_px) {
  const Camera square = SceneOf(RingOfViews(1)).cameras[0];
  Camera truth = square;
  truth.params[1] *= 1.01;
  PointScene made = PointsSeenBy(truth);
  made.points.resize(num_points);
  const std::vector<double> sigmas(made.scene.views.size(), sigma_px);
  const AdjustedPoses adjusted =
      AdjustPoses({made.scene, {}, made.points, sigmas, sigma_px, 50, {true}},
                  {std::vector<Rigid3>(made.scene.views.size()), {square}},
                  1,
                  KeepGoing);
  const std::vector<double>& params = adjusted.moved.cameras[0].params;
  return params[1] / params[0];
}

TEST(AdjustPoses, TakesPixelsForSquareUnlessMuchSaysOtherwise) {
  EXPECT_NEAR(RatioFoundFrom(300, 0.1), 1.01, 1e-3);
  EXPECT_NEAR(RatioFoundFrom(5, 2), 1, 1e-3);
}

// Images with few observations and a camera each. All are of one camera in
// fact, but for the last, whose focal length is twice as long.
TEST(AdjustPoses, BringsCamerasTogetherThatAreAlike) {
  Camera camera{CameraModel::kSimplePinhole, 640, 480, {600, 320, 240}};
  PointScene made = PointsSeenBy(camera);
  camera.params[0] = 1200;
  const PointScene near = PointsSeenBy(camera);
  const std::size_t num_views = made.scene.views.size();
  const auto last = static_cast<std::int32_t>(num_views - 1);
  made.points.resize(8);
  Random random(7);
  for (std::size_t k = 0; k < made.points.size(); ++k) {
    auto& observations = made.points[k].observations;
    std::erase_if(observations,
                  [&](const auto& seen) { return seen.view_idx == last; });
    for (const auto& seen : near.points[k].observations) {
      if (seen.view_idx == last) observations.push_back(seen);
    }
    for (auto& seen : observations) {
      seen.pixel += 2 * random.NormalVector().head<2>();
    }
  }
  made.scene.cameras.clear();
  for (std::size_t i = 0; i < num_views; ++i) {
    camera.params[0] = i + 1 == num_views ? 1200 : i % 2 == 0 ? 580 : 620;
    made.scene.cameras.push_back(camera);
    made.scene.views[i].camera_idx = static_cast<std::int32_t>(i);
  }
  const std::vector<bool> all_free(num_views, true);
  const std::vector<double> sigmas(num_views, 2);
  MovedCameras moved{std::vector<Rigid3>(num_views), made.scene.cameras};
  for (int i = 0; i < 5; ++i) {
    moved = AdjustPoses({made.scene, {}, made.points, sigmas, 2, 50, all_free},
                        moved,
                        1,
                        KeepGoing)
                .moved;
  }
  double least = 1e3;
  double largest = 0;
  for (std::size_t i = 0; i + 1 < num_views; ++i) {
    least = std::min(least, moved.cameras[i].params[0]);
    largest = std::max(largest, moved.cameras[i].params[0]);
  }
  EXPECT_LT(largest - least, 10);
  EXPECT_NEAR(moved.cameras.back().params[0], 1200, 50);
}

TEST(AdjustPoses, LeavesCamerasAloneThatAreNotFree) {
  PointScene made = PointsSeenBy(SceneOf(RingOfViews(1)).cameras[0]);
  made.scene.cameras[0].params[0] *= 1.01;
  const std::vector<double> sigmas(made.scene.views.size(), 0.2);
  const AdjustedPoses adjusted = AdjustPoses(
      {made.scene, {}, made.points, sigmas, 0.2, 50, {false}},
      {std::vector<Rigid3>(made.scene.views.size()), made.scene.cameras},
      1,
      KeepGoing);
  EXPECT_EQ(adjusted.moved.cameras[0].params, made.scene.cameras[0].params);
}

}  // namespace
}  // namespace curvix
