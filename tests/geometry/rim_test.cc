// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/rim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

constexpr double kSigmaPx = 0.5;
constexpr double kRadius = 0.05;  // some six pixels

// What the views of one side see of an upright cylinder around the origin: the
// end of it on their right.
std::vector<PlaneMeasurement> MeasureCylinder(double radius,
                                              std::size_t num_views) {
  const std::vector<PosedView> views = RingOfViews(24);
  std::vector<PlaneMeasurement> measurements;
  for (std::size_t i = 0; i < num_views; ++i) {
    const Eigen::Vector2d center = views[i].center.head<2>();
    // The ray to the rim makes a right angle with the radius that ends there.
    const double cosine = radius / center.norm();
    const Eigen::Vector2d side =
        Eigen::Rotation2Dd(std::acos(cosine)) * center.normalized();
    const SpaceEdge rim{{radius * side.x(), radius * side.y(), 0},
                        Eigen::Vector3d::UnitZ()};
    measurements.push_back(MeasurePlane(views[i], *ProjectEdge(views[i], rim)));
  }
  return measurements;
}

// An edge, to start from.
Rim StartAt(const Eigen::Vector3d& position) {
  Rim rim;
  rim.axis = {position, Eigen::Vector3d::UnitZ()};
  return rim;
}

Rim AdjustTwice(const Rim& start,
                const std::vector<PlaneMeasurement>& measurements) {
  return AdjustRim(
      AdjustRim(start, measurements, kSigmaPx), measurements, kSigmaPx);
}

double DistanceOfAxisFromOrigin(const Rim& rim) {
  return rim.axis.position.head<2>().norm();
}

TEST(AdjustRim, FindsAxisAndRadiusOfACylinder) {
  const auto measurements = MeasureCylinder(kRadius, 5);
  Rim rim = StartAt({0.01, 0.045, 0});
  for (int i = 0; i < 4; ++i) rim = AdjustRim(rim, measurements, kSigmaPx);
  EXPECT_NEAR(std::abs(rim.radius), kRadius, 0.02 * kRadius);
  EXPECT_LT(DistanceOfAxisFromOrigin(rim), 0.02 * kRadius);
}

TEST(AdjustRim, SeesEveryMeasurementWhereItIs) {
  const auto measurements = MeasureCylinder(kRadius, 5);
  const Rim rim = AdjustTwice(StartAt({0.01, 0.045, 0}), measurements);
  for (const PlaneMeasurement& m : measurements) {
    const SeenDistance seen = DistanceFrom(m, SeenFrom(rim, m.center).position);
    EXPECT_LT(std::abs(seen.px), 0.02);
  }
}

TEST(AdjustRim, LeavesAnEdgeAnEdge) {
  const auto measurements = MeasureCylinder(0, 8);
  const Rim rim = AdjustTwice(StartAt({0.004, -0.003, 0}), measurements);
  EXPECT_LT(std::abs(rim.radius), 1e-5);
  EXPECT_LT(DistanceOfAxisFromOrigin(rim), 1e-5);
}

TEST(AdjustRim, TakesWhatTwoViewsSeeForAnEdge) {
  const auto measurements = MeasureCylinder(kRadius, 2);
  const Rim rim = AdjustTwice(StartAt({0.01, 0.045, 0}), measurements);
  EXPECT_LT(std::abs(rim.radius), 0.1 * kRadius);
  for (const PlaneMeasurement& m : measurements) {
    EXPECT_LT(std::abs(DistanceFrom(m, SeenFrom(rim, m.center).position).px),
              0.02);
  }
}

TEST(AdjustRim, LeavesAnEdgeAnEdgeWhereRaysTellNothingOfARadius) {
  const auto all = MeasureCylinder(0, 2);
  // Six views within some fifteen degrees, of which only one differs.
  const std::vector<PlaneMeasurement> measurements = {
      all[0], all[0], all[0], all[0], all[0], all[1]};
  const Rim rim = AdjustTwice(StartAt({0.01, -0.01, 0}), measurements);
  EXPECT_LT(std::abs(rim.radius), 1e-3);
  EXPECT_LT(DistanceOfAxisFromOrigin(rim), 1e-3);
}

TEST(AdjustRim, KeepsItsSideWhenAskedAgain) {
  const auto measurements = MeasureCylinder(kRadius, 5);
  const Rim once = AdjustTwice(StartAt({0.01, 0.045, 0}), measurements);
  const Rim again = AdjustRim(once, measurements, kSigmaPx);
  EXPECT_GT(once.outward.dot(again.outward), 0.99);
  EXPECT_NEAR(once.radius, again.radius, 0.01 * kRadius);
}

TEST(SideSeenFrom, IsTheSameFromTheOtherSide) {
  Rim rim = StartAt({0.1, 0.2, 0.3});
  rim.outward = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d center(4, 3, 2);
  const Eigen::Vector3d opposite = 2 * rim.axis.position - center;
  EXPECT_LT((SideSeenFrom(rim, center) - SideSeenFrom(rim, opposite)).norm(),
            1e-12);
}

TEST(SideSeenFrom, IsZeroAlongTheAxis) {
  Rim rim = StartAt({0.1, 0.2, 0.3});
  rim.outward = Eigen::Vector3d::UnitX();
  EXPECT_TRUE(SideSeenFrom(rim, {0.1, 0.2, 7}).isZero(0));
}

TEST(SeenFrom, IsAcrossAxisAndRay) {
  Rim rim = StartAt({0.1, 0.2, 0.3});
  rim.radius = 0.5;
  rim.outward = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d center(4, 3, 2);
  const Eigen::Vector3d side = SideSeenFrom(rim, center);
  const SpaceEdge seen = SeenFrom(rim, center);
  EXPECT_NEAR(side.norm(), 1, 1e-12);
  EXPECT_GT(side.dot(rim.outward), 0);
  EXPECT_NEAR(side.dot(rim.axis.tangent), 0, 1e-12);
  EXPECT_NEAR(side.dot(rim.axis.position - center), 0, 1e-12);
  EXPECT_NEAR((seen.position - rim.axis.position).norm(), 0.5, 1e-12);
}

}  // namespace
}  // namespace curvix
