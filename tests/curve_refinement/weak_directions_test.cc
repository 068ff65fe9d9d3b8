// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/weak_directions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/curve_refinement/drawn_curves.h"

namespace curvix {
namespace {

// Of a place whose standard deviations in depth and height are as `ratio` to
// one.
Eigen::Matrix3d Information(double ratio) {
  return Eigen::Vector3d(0, 1 / (ratio * ratio), 1).asDiagonal();
}

std::vector<std::optional<WeakDirection>> WeakDirectionsOf(const Curve& curve,
                                                           double ratio) {
  return WeakDirections(
      curve,
      std::vector<Eigen::Matrix3d>(curve.samples.size(), Information(ratio)));
}

// A line whose tangents turn to and fro in depth.
Curve ZigzagInDepth() {
  Curve curve = Line(InPlane(-10, 0), InPlane(10, 0));
  for (std::size_t k = 0; k < curve.samples.size(); ++k) {
    curve.samples[k].tangent =
        Eigen::Vector3d(1, k % 2 == 0 ? 0.5 : -0.5, 0).normalized();
  }
  return curve;
}

TEST(WeakDirections, DepthIsWeakOnALine) {
  for (const auto& weak :
       WeakDirectionsOf(Line(InPlane(-10, 0), InPlane(10, 0)), 4)) {
    ASSERT_TRUE(weak);
    EXPECT_NEAR(std::abs(weak->direction.y()), 1, 1e-9);
    EXPECT_NEAR(weak->ratio, 4, 1e-9);
  }
}

TEST(WeakDirections, NoneOfPlacesThatAreDeterminedAllAround) {
  for (const auto& weak :
       WeakDirectionsOf(Line(InPlane(-10, 0), InPlane(10, 0)), 1.9)) {
    EXPECT_FALSE(weak);
  }
}

TEST(WeakDirections, ZigzagsInDepthDoNotHideIt) {
  const auto weak = WeakDirectionsOf(ZigzagInDepth(), 4);
  ASSERT_TRUE(weak[10]);
  EXPECT_GT(std::abs(weak[10]->direction.y()), 0.99);
}

TEST(WeakDirections, NoneWhereImagesSeeACorner) {
  Curve corner = Line(InPlane(-10, 0), InPlane(0, 0));
  const Curve other = Line(InPlane(0, 1), InPlane(0, 10));
  corner.samples.insert(
      corner.samples.end(), other.samples.begin(), other.samples.end());
  const auto weak = WeakDirectionsOf(corner, 4);
  EXPECT_TRUE(weak[0]);
  EXPECT_FALSE(weak[5]);
  EXPECT_FALSE(weak[10]);
  EXPECT_TRUE(weak[20]);
}

TEST(WeakDirections, NoneOnSmallCircles) {
  const Curve circle = Arc(30, 0, 2 * std::numbers::pi);
  std::vector<Eigen::Matrix3d> information;
  for (const CurveSample& sample : circle.samples) {
    const Eigen::Vector3d normal = sample.position.normalized();
    information.push_back(Information(4));
    information.back().col(2).setZero();
    information.back() += normal * normal.transpose();
  }
  for (const auto& weak : WeakDirections(circle, information)) {
    EXPECT_FALSE(weak);
  }
}

TEST(WeakDirections, NoneWithoutMeasurements) {
  const Curve line = Line(InPlane(-10, 0), InPlane(10, 0));
  for (const auto& weak :
       WeakDirections(line,
                      std::vector<Eigen::Matrix3d>(line.samples.size(),
                                                   Eigen::Matrix3d::Zero()))) {
    EXPECT_FALSE(weak);
  }
}

}  // namespace
}  // namespace curvix
