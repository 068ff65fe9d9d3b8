// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/adjust_edge.h"

#include <gtest/gtest.h>
#include <cmath>

#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

constexpr double kContourSigmaPx = 0.5;
constexpr double kRadius = 0.05;  // some six pixels

// What the views of one side see of an upright cylinder around the origin: the
// end of it on their right.
std::vector<PlaneMeasurement> MeasureCylinder(double radius,
                                              std::size_t num_views) {
  const std::vector<PosedView> views = RingOfViews(24);
  std::vector<PlaneMeasurement> measurements;
  for (std::size_t i = 0; i < num_views; ++i) {
    const Eigen::Vector2d center = views[i].center.head<2>();
    // The ray to the contour makes a right angle with the radius that ends
    // there.
    const double cosine = radius / center.norm();
    const Eigen::Vector2d side =
        Eigen::Rotation2Dd(std::acos(cosine)) * center.normalized();
    const SpaceEdge contour{{radius * side.x(), radius * side.y(), 0},
                            Eigen::Vector3d::UnitZ()};
    measurements.push_back(
        MeasurePlane(views[i], *ProjectEdge(views[i], contour)));
  }
  return measurements;
}

// An edge, to start from.
OccludingContour StartAt(const Eigen::Vector3d& position) {
  OccludingContour contour;
  contour.axis = {position, Eigen::Vector3d::UnitZ()};
  return contour;
}

OccludingContour AdjustTwice(
    const OccludingContour& start,
    const std::vector<PlaneMeasurement>& measurements) {
  return AdjustOccludingContour(
      AdjustOccludingContour(start, measurements, kContourSigmaPx),
      measurements,
      kContourSigmaPx);
}

double DistanceOfAxisFromOrigin(const OccludingContour& contour) {
  return contour.axis.position.head<2>().norm();
}

TEST(AdjustOccludingContour, FindsAxisAndRadiusOfACylinder) {
  const auto measurements = MeasureCylinder(kRadius, 5);
  OccludingContour contour = StartAt({0.01, 0.045, 0});
  for (int i = 0; i < 4; ++i)
    contour = AdjustOccludingContour(contour, measurements, kContourSigmaPx);
  EXPECT_NEAR(std::abs(contour.radius), kRadius, 0.02 * kRadius);
  EXPECT_LT(DistanceOfAxisFromOrigin(contour), 0.02 * kRadius);
}

TEST(AdjustOccludingContour, SeesEveryMeasurementWhereItIs) {
  const auto measurements = MeasureCylinder(kRadius, 5);
  const OccludingContour contour =
      AdjustTwice(StartAt({0.01, 0.045, 0}), measurements);
  for (const PlaneMeasurement& m : measurements) {
    const SeenDistance seen =
        DistanceFrom(m, SeenFrom(contour, m.center).position);
    EXPECT_LT(std::abs(seen.px), 0.02);
  }
}

TEST(AdjustOccludingContour, LeavesAnEdgeAnEdge) {
  const auto measurements = MeasureCylinder(0, 8);
  const OccludingContour contour =
      AdjustTwice(StartAt({0.004, -0.003, 0}), measurements);
  EXPECT_LT(std::abs(contour.radius), 1e-5);
  EXPECT_LT(DistanceOfAxisFromOrigin(contour), 1e-5);
}

TEST(AdjustOccludingContour, TakesWhatTwoViewsSeeForAnEdge) {
  const auto measurements = MeasureCylinder(kRadius, 2);
  const OccludingContour contour =
      AdjustTwice(StartAt({0.01, 0.045, 0}), measurements);
  EXPECT_LT(std::abs(contour.radius), 0.1 * kRadius);
  for (const PlaneMeasurement& m : measurements) {
    EXPECT_LT(
        std::abs(DistanceFrom(m, SeenFrom(contour, m.center).position).px),
        0.02);
  }
}

TEST(AdjustOccludingContour, LeavesAnEdgeAnEdgeWhereRaysTellNothingOfARadius) {
  const auto all = MeasureCylinder(0, 2);
  // Six views within some fifteen degrees, of which only one differs.
  const std::vector<PlaneMeasurement> measurements = {
      all[0], all[0], all[0], all[0], all[0], all[1]};
  const OccludingContour contour =
      AdjustTwice(StartAt({0.01, -0.01, 0}), measurements);
  EXPECT_LT(std::abs(contour.radius), 1e-3);
  EXPECT_LT(DistanceOfAxisFromOrigin(contour), 1e-3);
}

TEST(AdjustOccludingContour, KeepsItsSideWhenAskedAgain) {
  const auto measurements = MeasureCylinder(kRadius, 5);
  const OccludingContour once =
      AdjustTwice(StartAt({0.01, 0.045, 0}), measurements);
  const OccludingContour again =
      AdjustOccludingContour(once, measurements, kContourSigmaPx);
  EXPECT_GT(once.outward.dot(again.outward), 0.99);
  EXPECT_NEAR(once.radius, again.radius, 0.01 * kRadius);
}

TEST(SideSeenFrom, IsTheSameFromTheOtherSide) {
  OccludingContour contour = StartAt({0.1, 0.2, 0.3});
  contour.outward = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d center(4, 3, 2);
  const Eigen::Vector3d opposite = 2 * contour.axis.position - center;
  EXPECT_LT(
      (SideSeenFrom(contour, center) - SideSeenFrom(contour, opposite)).norm(),
      1e-12);
}

TEST(SideSeenFrom, IsZeroAlongTheAxis) {
  OccludingContour contour = StartAt({0.1, 0.2, 0.3});
  contour.outward = Eigen::Vector3d::UnitX();
  EXPECT_TRUE(SideSeenFrom(contour, {0.1, 0.2, 7}).isZero(0));
}

TEST(SeenFrom, IsAcrossAxisAndRay) {
  OccludingContour contour = StartAt({0.1, 0.2, 0.3});
  contour.radius = 0.5;
  contour.outward = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d center(4, 3, 2);
  const Eigen::Vector3d side = SideSeenFrom(contour, center);
  const SpaceEdge seen = SeenFrom(contour, center);
  EXPECT_NEAR(side.norm(), 1, 1e-12);
  EXPECT_GT(side.dot(contour.outward), 0);
  EXPECT_NEAR(side.dot(contour.axis.tangent), 0, 1e-12);
  EXPECT_NEAR(side.dot(contour.axis.position - center), 0, 1e-12);
  EXPECT_NEAR((seen.position - contour.axis.position).norm(), 0.5, 1e-12);
}

}  // namespace
}  // namespace curvix
