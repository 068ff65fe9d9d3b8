// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/edge_geometry.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/angles.h"
#include "geometry/detected_edge.h"
#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMinRayAngle = 0.02, kMinPlaneAngle = 0.02;

// A view near `center` that looks about at the origin and is not symmetric.
PosedView OddView(const Vector3d& center, Random& random) {
  PosedView view = LookAt(center, 0.2 * random.UnitVector());
  view.calibration(0, 0) = 700;
  view.calibration(1, 1) = 450;
  view.calibration(0, 2) = 377;
  return view;
}

SpaceEdge RandomEdge(Random& random) {
  return {0.5 * random.UnitVector(), random.UnitVector()};
}

TEST(TriangulateEdge, UndoesProjection) {
  Random random(1);
  int triangulated = 0;
  for (int i = 0; i < 300; ++i) {
    const PosedView view1 = OddView({4, 0, 1}, random);
    const PosedView view2 = OddView({3, 2, -1}, random);
    const SpaceEdge edge = RandomEdge(random);
    const auto edge1 = ProjectEdge(view1, edge);
    const auto edge2 = ProjectEdge(view2, edge);
    ASSERT_TRUE(edge1 && edge2);
    const auto back = TriangulateEdge(
        view1, *edge1, view2, *edge2, kMinRayAngle, kMinPlaneAngle);
    if (!back) continue;  // the edge lies in an epipolar plane
    ++triangulated;
    EXPECT_LT((back->position - edge.position).norm(), 1e-12);
    EXPECT_LT(back->tangent.cross(edge.tangent).norm(), 1e-11);
    EXPECT_NEAR(back->tangent.norm(), 1, 1e-12);
  }
  EXPECT_GT(triangulated, 270);
}

TEST(TriangulateEdge, LiesOnTheRayOfTheFirstEdge) {
  Random random(2);
  const PosedView view1 = OddView({4, 0, 1}, random);
  const PosedView view2 = OddView({3, 2, -1}, random);
  const Vector2d pixel1 = PixelOf(view1, {0.1, 0.2, 0.3});
  const Vector2d pixel2 = PixelOf(view2, {0.1, 0.2, 0.3}) + Vector2d(3, -4);
  const auto edge = TriangulateEdge(view1,
                                    {pixel1, {0, 1}},
                                    view2,
                                    {pixel2, {0, 1}},
                                    kMinRayAngle,
                                    kMinPlaneAngle);
  ASSERT_TRUE(edge);
  EXPECT_LT((PixelOf(view1, edge->position) - pixel1).norm(), 1e-9);
  // Nearest to the other ray: the connection is at right angles to both.
  const Vector3d ray2 = view2.Ray(pixel2).normalized();
  const Vector3d to_edge = edge->position - view2.center;
  const Vector3d gap = to_edge - to_edge.dot(ray2) * ray2;
  EXPECT_GT(gap.norm(), 1e-3);
  EXPECT_NEAR(gap.dot(view1.Ray(pixel1).normalized()), 0, 1e-12);
}

TEST(TriangulateEdge, RefusesRaysThatMeetBehindACamera) {
  const PosedView left = MakeView(Matrix3d::Identity(), {0, 0, 0});
  const PosedView right = MakeView(Matrix3d::Identity(), {1, 0, 0});
  const ImageEdge in_left{{400, 400}, {0, 1}};
  const ImageEdge nearer{{240, 400}, {0, 1}};     // disparity 160: depth 5
  const ImageEdge diverging{{560, 400}, {0, 1}};  // meets behind both
  EXPECT_TRUE(TriangulateEdge(
      left, in_left, right, nearer, kMinRayAngle, kMinPlaneAngle));
  EXPECT_FALSE(TriangulateEdge(
      left, in_left, right, diverging, kMinRayAngle, kMinPlaneAngle));
}

TEST(TriangulateEdge, RefusesRaysThatAreNearlyParallel) {
  const PosedView left = MakeView(Matrix3d::Identity(), {0, 0, 0});
  const PosedView right = MakeView(Matrix3d::Identity(), {1, 0, 0});
  const ImageEdge in_left{{400, 400}, {0, 1}};
  const auto at_angle = [&](double angle) {
    const ImageEdge in_right{{400 - 800 * std::tan(angle), 400}, {0, 1}};
    return TriangulateEdge(
        left, in_left, right, in_right, DegToRad(2), kMinPlaneAngle);
  };
  EXPECT_TRUE(at_angle(DegToRad(2.01)));
  EXPECT_FALSE(at_angle(DegToRad(1.99)));
  EXPECT_FALSE(at_angle(0));
}

TEST(TriangulateEdge, RefusesEdgesAlongTheEpipolarLine) {
  const PosedView left = MakeView(Matrix3d::Identity(), {0, 0, 0});
  const PosedView right = MakeView(Matrix3d::Identity(), {1, 0, 0});
  const auto with_direction = [&](double angle) {
    const Vector2d tangent(std::cos(angle), std::sin(angle));
    return TriangulateEdge(left,
                           {{400, 300}, tangent},
                           right,
                           {{200, 300}, tangent},
                           kMinRayAngle,
                           DegToRad(1));
  };
  EXPECT_FALSE(with_direction(0));
  EXPECT_FALSE(with_direction(kPi));
  EXPECT_TRUE(with_direction(DegToRad(30)));
}

TEST(EdgePlane, MeasuresTheSignedPixelDistance) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const PosedView view = OddView({4, 0, 1}, random);
    const double angle = random.Uniform(-kPi, kPi);
    const ImageEdge edge{{random.Uniform(0, 800), random.Uniform(0, 800)},
                         {std::cos(angle), std::sin(angle)}};
    const Vector3d x = random.UnitVector();
    const Vector3d in_camera = view.InCamera(x);
    const double distance =
        EdgePlane(view, edge).dot(x - view.center) / in_camera.z();
    const Vector2d normal(-edge.tangent.y(), edge.tangent.x());
    EXPECT_NEAR(
        distance, normal.dot(view.Pixel(in_camera) - edge.position), 1e-9);
  }
}

TEST(ProjectEdge, TurnsTheTangentAsFiniteDifferencesDo) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const PosedView view = OddView({4, 0, 1}, random);
    const SpaceEdge edge = RandomEdge(random);
    const auto projected = ProjectEdge(view, edge);
    ASSERT_TRUE(projected);
    const Vector3d h = 1e-5 * edge.tangent;
    const Vector2d move =
        PixelOf(view, edge.position + h) - PixelOf(view, edge.position - h);
    EXPECT_LT((projected->position - PixelOf(view, edge.position)).norm(),
              1e-12);
    // Steps foreshortened to a hundredth leave a hundredth of the accuracy.
    EXPECT_LT((projected->tangent - move.normalized()).norm(), 1e-5);
  }
}

TEST(ProjectEdge, HasNoImageBehindTheCameraOrAlongTheRay) {
  const PosedView view = MakeView(Matrix3d::Identity(), {0, 0, 0});
  EXPECT_TRUE(ProjectEdge(view, {{0, 0, 2}, {1, 0, 0}}));
  EXPECT_FALSE(ProjectEdge(view, {{0, 0, -2}, {1, 0, 0}}));
  EXPECT_FALSE(ProjectEdge(view, {{0, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(ProjectEdge(view, {{0, 0, 2}, {0, 0, 1}}));
  const Vector3d along_the_ray = Vector3d(1, 2, 5).normalized();
  EXPECT_FALSE(ProjectEdge(view, {{1, 2, 5}, along_the_ray}));
}

TEST(ToImageEdge, TurnsTheAngleIntoAUnitTangent) {
  Edge2d edge;
  edge.position = {3, 4};
  edge.angle = static_cast<float>(kPi / 2);
  EXPECT_EQ(ToImageEdge(edge).position, edge.position);
  EXPECT_LT((ToImageEdge(edge).tangent - Vector2d(0, 1)).norm(), 1e-6);
}

}  // namespace
}  // namespace curvix
