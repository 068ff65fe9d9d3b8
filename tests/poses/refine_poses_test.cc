// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/refine_poses.h>
#include <curvix/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "base/median.h"
#include "edge_detection/undistort_edges.h"
#include "geometry/similarity.h"
#include "tests/invariance/compare_runs.h"
#include "tests/support/random.h"
#include "tests/support/wire_scene.h"

namespace curvix {
namespace {

const WireScene& Wires() {
  static const WireScene wires = MakeWireScene(CubeAndCircle(), 14);
  return wires;
}

// Turns and shifts each camera by what moves its picture by `px` (root mean
// square).
Scene Disturbed(Scene scene, double px) {
  Random random(4);
  for (View& view : scene.views) {
    const double focal_px = CameraOf(scene, view).params[0];
    const double sigma = px / 2 / focal_px;
    Rigid3 increment;
    const Eigen::Vector3d turn = sigma * random.NormalVector();
    if (px > 0) {
      increment.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized());
    }
    increment.translation =
        sigma * view.cam_from_world.translation.norm() * random.NormalVector();
    view.cam_from_world = increment * view.cam_from_world;
  }
  return scene;
}

std::vector<Rigid3> PosesOf(const Scene& scene) {
  std::vector<Rigid3> poses;
  for (const View& view : scene.views) poses.push_back(view.cam_from_world);
  return poses;
}

// How far true places project in view i by `pose` from where they would by
// `meant`. Pixels.
std::vector<double> ShiftsIn(std::size_t i,
                             const Rigid3& pose,
                             const Rigid3& meant) {
  const Scene& truth = Wires().scene;
  const Eigen::Matrix3d k = PinholeCalibration(CameraOf(truth, truth.views[i]));
  std::vector<double> shifts;
  for (const TestCurve& curve : Wires().truth) {
    for (double s = 0; s < curve.length; s += curve.length / 10) {
      const Eigen::Vector3d x = curve.position(s);
      const Eigen::Vector2d seen = (k * (pose * x)).hnormalized();
      shifts.push_back((seen - (k * (meant * x)).hnormalized()).norm());
    }
  }
  return shifts;
}

// The median over all views, once `poses` are brought to the world of `meant`.
double MedianShift(const std::vector<Rigid3>& poses,
                   const std::vector<Rigid3>& meant = PosesOf(Wires().scene)) {
  const auto aligned = AlignPoses(poses, meant);
  EXPECT_TRUE(aligned);
  std::vector<double> shifts;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::vector<double> more =
        ShiftsIn(i, MovePose(*aligned, poses[i]), meant[i]);
    shifts.insert(shifts.end(), more.begin(), more.end());
  }
  return Median(std::move(shifts));
}

CurvePoses Refine(const Scene& scene,
                  const std::vector<EdgeMap>& edge_maps,
                  int num_threads = 0) {
  Options options;
  options.runtime.num_threads = num_threads;
  const auto refined = RefinePosesWithCurves(scene, edge_maps, options);
  EXPECT_TRUE(refined.ok()) << refined.status().message();
  return *refined;
}

// Of the first views of Wires(), in order.
std::vector<EdgeMap> EdgesOf(const Scene& scene) {
  std::vector<EdgeMap> edge_maps = Wires().edge_maps;
  edge_maps.resize(scene.views.size());
  return edge_maps;
}

CurvePoses Refine(const Scene& scene, int num_threads = 0) {
  return Refine(scene, EdgesOf(scene), num_threads);
}

// Enough for invariance tests.
Scene FewDisturbedViews() {
  Scene scene = Disturbed(Wires().scene, 1);
  scene.views.resize(9);
  return scene;
}

TEST(RefinePosesWithCurves, BringsPosesThatAreAPixelOffToATenth) {
  const Scene disturbed = Disturbed(Wires().scene, 1);
  ASSERT_GT(MedianShift(PosesOf(disturbed)), 0.5);
  const CurvePoses refined = Refine(disturbed);
  EXPECT_TRUE(refined.accepted) << refined.reason;
  EXPECT_LE(MedianShift(refined.cam_from_world), 0.1);
  EXPECT_LT(refined.after.mean_px, 0.5 * refined.before.mean_px);
  EXPECT_GT(refined.num_check_observations, 100u);
  EXPECT_EQ(refined.cameras, disturbed.cameras) << "which are right";
}

TEST(RefinePosesWithCurves, FindsPosesThatAreTwoPixelsOff) {
  const CurvePoses refined = Refine(Disturbed(Wires().scene, 2));
  EXPECT_TRUE(refined.accepted) << refined.reason;
  EXPECT_LE(MedianShift(refined.cam_from_world), 0.1);
}

TEST(RefinePosesWithCurves, FindsTheFewPosesThatAreWrong) {
  const Scene& truth = Wires().scene;
  const Scene disturbed = Disturbed(truth, 2);
  Scene scene = truth;
  for (const std::size_t i : {3u, 10u}) scene.views[i] = disturbed.views[i];
  const CurvePoses refined = Refine(scene);
  EXPECT_TRUE(refined.accepted) << refined.reason;
  for (const std::size_t i : {3u, 10u}) {
    const auto shift = [&](const Rigid3& pose) {
      return Median(ShiftsIn(i, pose, truth.views[i].cam_from_world));
    };
    EXPECT_GT(shift(scene.views[i].cam_from_world), 2) << "in view " << i;
    EXPECT_LE(shift(refined.cam_from_world[i]), 0.2) << "in view " << i;
  }
}

TEST(RefinePosesWithCurves, LeavesTruePosesAlone) {
  const CurvePoses refined = Refine(Wires().scene);
  EXPECT_LE(MedianShift(refined.cam_from_world), 0.02) << refined.reason;
}

// 200 points on a sphere, as `camera` sees them from the poses of the scene.
void AddPoints(const Camera& camera, double radius, Scene* scene) {
  Random random(6);
  for (std::size_t k = 0; k < 200; ++k) {
    ScenePoint& point = scene->points.emplace_back();
    point.position = radius * random.UnitVector();
    for (std::size_t i = k % 3; i < scene->views.size(); i += 3) {
      const auto pixel =
          Project(camera, scene->views[i].cam_from_world, point.position);
      ASSERT_TRUE(pixel);
      point.view_idxs.push_back(static_cast<std::int32_t>(i));
      point.pixels.push_back(*pixel);
    }
  }
}

// Poses that points fit exactly: nothing could be better by the points.
TEST(RefinePosesWithCurves, LeavesPosesAloneThatPointsFit) {
  Scene scene = Disturbed(Wires().scene, 0.5);
  AddPoints(CameraOf(scene, scene.views[0]), 0.5, &scene);
  const CurvePoses refined = Refine(scene);
  EXPECT_FALSE(refined.accepted);
  EXPECT_EQ(refined.reason, "the points are where the poses put them");
  EXPECT_EQ(refined.cam_from_world[3].translation,
            scene.views[3].cam_from_world.translation);
}

TEST(RefinePosesWithCurves, KeepsTheScaleOfTheWorld) {
  const Scene disturbed = Disturbed(Wires().scene, 1);
  const auto back =
      AlignPoses(Refine(disturbed).cam_from_world, PosesOf(disturbed));
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->scale, 1, 1e-3);
}

TEST(RefinePosesWithCurves, DoesNotDependOnTheNumberOfThreads) {
  const Scene disturbed = FewDisturbedViews();
  const CurvePoses expected = Refine(disturbed, 1);
  for (const int num_threads : {2, 3, 8}) {
    SCOPED_TRACE(num_threads);
    const CurvePoses refined = Refine(disturbed, num_threads);
    for (std::size_t i = 0; i < expected.cam_from_world.size(); ++i) {
      const Rigid3& a = expected.cam_from_world[i];
      const Rigid3& b = refined.cam_from_world[i];
      EXPECT_EQ(a.rotation.coeffs(), b.rotation.coeffs());
      EXPECT_EQ(a.translation, b.translation);
    }
  }
}

// But for where optimisers stop: a thousandth of a pixel.
TEST(RefinePosesWithCurves, TheWorldsFrameAndUnitMakeNoDifference) {
  const Scene disturbed = FewDisturbedViews();
  Random random(5);
  const OtherWorld world{
      Eigen::Quaterniond(random.Rotation()), random.UnitVector(), 1000};
  const CurvePoses moved = Refine(world.Moved(disturbed));
  ASSERT_TRUE(moved.accepted) << moved.reason;
  const CurvePoses refined = Refine(disturbed);
  EXPECT_LT(MedianShift(moved.cam_from_world, refined.cam_from_world), 0.001);
}

TEST(RefinePosesWithCurves, TheOrderOfTheViewsMakesNoDifference) {
  const Scene disturbed = FewDisturbedViews();
  Scene reversed = disturbed;
  std::reverse(reversed.views.begin(), reversed.views.end());
  std::vector<EdgeMap> edge_maps = EdgesOf(disturbed);
  std::reverse(edge_maps.begin(), edge_maps.end());
  CurvePoses refined = Refine(reversed, edge_maps);
  ASSERT_TRUE(refined.accepted) << refined.reason;
  std::reverse(refined.cam_from_world.begin(), refined.cam_from_world.end());
  EXPECT_LT(
      MedianShift(refined.cam_from_world, Refine(disturbed).cam_from_world),
      0.001);
}

// The photographs of Wires(), taken to be those of another lens.
struct WrongLens {
  Scene scene = Wires().scene;
  std::vector<EdgeMap> edge_maps = Wires().edge_maps;

  explicit WrongLens(double true_k = 0, double wrong_k = 0.15) {
    const Camera pinhole = scene.cameras[0];
    const std::vector<double>& p = pinhole.params;
    const auto with = [&](double k) {
      return Camera{CameraModel::kSimpleRadial,
                    pinhole.width,
                    pinhole.height,
                    {p[0], p[p.size() - 2], p[p.size() - 1], k}};
    };
    const Camera truth = with(true_k), wrong = with(wrong_k);
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
      int& camera_idx = scene.views[i].camera_idx;
      EXPECT_EQ(scene.cameras[static_cast<std::size_t>(camera_idx)], pinhole);
      camera_idx = 0;
      edge_maps[i] = *CarryEdges(edge_maps[i], truth, wrong);
    }
    scene.cameras = {wrong};
  }
};

TEST(RefinePosesWithCurves, MendsALensThatIsOff) {
  const WrongLens wrong;
  const CurvePoses refined = Refine(wrong.scene, wrong.edge_maps);
  ASSERT_TRUE(refined.accepted) << refined.reason;
  EXPECT_LT(std::abs(refined.cameras[0].params[3]), 0.04);
  EXPECT_LE(MedianShift(refined.cam_from_world), 0.15);
}

// Another focal length asks for another unit of the world, which scales it
// about what is seen.
TEST(RefinePosesWithCurves, AnOriginFarAwayMakesNoDifference) {
  const WrongLens wrong;
  const OtherWorld far_away{
      Eigen::Quaterniond::Identity(), {1e5, -1e5, 1e4}, 1};
  const CurvePoses moved = Refine(far_away.Moved(wrong.scene), wrong.edge_maps);
  ASSERT_TRUE(moved.accepted) << moved.reason;
  const CurvePoses refined = Refine(wrong.scene, wrong.edge_maps);
  EXPECT_NEAR(moved.max_shift_px, refined.max_shift_px, 0.05);
  EXPECT_LT(MedianShift(moved.cam_from_world, refined.cam_from_world), 0.01);
}

// The true lens sees nothing as far from the middle as one edge is.
TEST(RefinePosesWithCurves, LeavesALensIfTheBetterCannotShowAnEdge) {
  WrongLens wrong(-0.4, -0.25);
  const CurvePoses mended = Refine(wrong.scene, wrong.edge_maps);
  EXPECT_NEAR(mended.cameras[0].params[3], -0.4, 0.01) << mended.reason;
  wrong.edge_maps[0].edges[0].position = {1, 1};
  const CurvePoses refined = Refine(wrong.scene, wrong.edge_maps);
  EXPECT_EQ(refined.cameras, wrong.scene.cameras);
  EXPECT_THAT(refined.reason,
              testing::HasSubstr("cameras stay: the camera of " +
                                 wrong.scene.views[0].name +
                                 " cannot be inverted at an edge"));
}

TEST(RefinePosesWithCurves, LeavesTheLensIfAsked) {
  const WrongLens wrong;
  const auto refined =
      RefinePosesWithCurves(wrong.scene, wrong.edge_maps, Options(), {}, false);
  ASSERT_TRUE(refined.ok()) << refined.status().message();
  EXPECT_EQ(refined->cameras, wrong.scene.cameras);
}

TEST(RefinePosesWithCurves,
     LeavesALensWithPointsIfAnotherShiftsTheImageTooFar) {
  WrongLens wrong;
  AddPoints(Wires().scene.cameras[0], 2, &wrong.scene);
  const CurvePoses refined = Refine(wrong.scene, wrong.edge_maps);
  EXPECT_EQ(refined.cameras, wrong.scene.cameras);
  EXPECT_THAT(refined.reason,
              testing::HasSubstr("cameras stay: others would shift images by"));
}

// Cameras in the reverse order of the views, and one that no view has.
TEST(RefinePosesWithCurves, MendsLensesOfSingleViews) {
  WrongLens wrong;
  const Camera camera = wrong.scene.cameras[0];
  const std::size_t num_views = wrong.scene.views.size();
  wrong.scene.cameras.assign(num_views + 1, camera);
  for (std::size_t i = 0; i < num_views; ++i) {
    wrong.scene.views[i].camera_idx = static_cast<int>(num_views - 1 - i);
  }
  const CurvePoses refined = Refine(wrong.scene, wrong.edge_maps);
  ASSERT_TRUE(refined.accepted) << refined.reason;
  EXPECT_EQ(refined.cameras.back(), camera);
  std::vector<double> errors;  // the true parameter is 0
  for (const Camera& mended : refined.cameras) {
    errors.push_back(std::abs(mended.params[3]));
  }
  const auto num_mended = static_cast<std::size_t>(std::count_if(
      errors.begin(), errors.end(), [](double error) { return error < 0.07; }));
  EXPECT_GE(5 * num_mended, 4 * num_views);
  EXPECT_LT(Median(std::move(errors)), 0.05);
  EXPECT_LE(MedianShift(refined.cam_from_world), 0.3);
}

TEST(RefinePosesWithCurves, KeepsThePosesWithoutEdges) {
  const Scene disturbed = Disturbed(Wires().scene, 1);
  const auto refined = RefinePosesWithCurves(
      disturbed, std::vector<EdgeMap>(disturbed.views.size()), Options());
  ASSERT_TRUE(refined.ok()) << refined.status().message();
  EXPECT_FALSE(refined->accepted);
  EXPECT_EQ(refined->reason, "too little is left to judge by");
  EXPECT_EQ(refined->cam_from_world[3].translation,
            disturbed.views[3].cam_from_world.translation);
}

TEST(RefinePosesWithCurves, StopsWhenAsked) {
  const auto refined =
      RefinePosesWithCurves(Wires().scene,
                            Wires().edge_maps,
                            Options(),
                            [](const std::string&, int, int) { return false; });
  EXPECT_EQ(refined.status().code(), StatusCode::kCancelled);
}

}  // namespace
}  // namespace curvix
