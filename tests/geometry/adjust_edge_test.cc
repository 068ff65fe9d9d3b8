// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/adjust_edge.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "tests/support/edges_along_baseline.h"
#include "tests/support/random.h"
#include "tests/support/synthetic_edges.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSigmaPx = 0.15;
const SpaceEdge kTruth{{0.3, -0.2, 0.1}, Vector3d(0.2, 0.3, 1).normalized()};

// The image of `edge`, moved across its tangent and slid along it.
PlaneMeasurement Measure(const PosedView& view,
                         const SpaceEdge& edge,
                         double across_px,
                         double along_px) {
  ImageEdge image = *ProjectEdge(view, edge);
  image.position +=
      across_px * Vector2d(-image.tangent.y(), image.tangent.x()) +
      along_px * image.tangent;
  return MeasurePlane(view, image);
}

std::vector<PlaneMeasurement> MeasureAll(const std::vector<PosedView>& views,
                                         double sigma_px,
                                         Random& random) {
  std::vector<PlaneMeasurement> measurements;
  for (const PosedView& view : views) {
    measurements.push_back(Measure(
        view, kTruth, sigma_px * random.Normal(), random.Uniform(-0.5, 0.5)));
  }
  return measurements;
}

SpaceEdge Start(Random& random) {
  return {kTruth.position + 0.01 * random.NormalVector(),
          (kTruth.tangent + 0.05 * random.NormalVector()).normalized()};
}

// Several calls, as tracking makes while it gathers support: one is not enough
// to settle from a start that is a pixel off.
EdgeEstimate AdjustRepeatedly(
    const SpaceEdge& start, const std::vector<PlaneMeasurement>& measurements) {
  EdgeEstimate estimate = AdjustEdge(start, measurements, kSigmaPx);
  for (int i = 0; i < 3; ++i) {
    estimate = AdjustEdge(estimate.edge, measurements, kSigmaPx);
  }
  return estimate;
}

double DistanceFromTruth(const Vector3d& x) {
  return kTruth.tangent.cross(x - kTruth.position).norm();
}

TEST(AdjustEdge, RecoversTheLineFromExactEdges) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const auto measurements = MeasureAll(RingOfViews(8), 0, random);
    const EdgeEstimate estimate =
        AdjustEdge(Start(random), measurements, kSigmaPx);
    EXPECT_LT(DistanceFromTruth(estimate.edge.position), 1e-6);
    EXPECT_LT(estimate.edge.tangent.cross(kTruth.tangent).norm(), 1e-6);
  }
}

TEST(AdjustEdge, MovesOnlyAcrossTheTangentOfTheStart) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const SpaceEdge start = Start(random);
    const EdgeEstimate estimate = AdjustEdge(
        start, MeasureAll(RingOfViews(8), kSigmaPx, random), kSigmaPx);
    const Vector3d move = estimate.edge.position - start.position;
    EXPECT_GT(move.norm(), 1e-4);
    EXPECT_LT(std::abs(move.dot(start.tangent)), 1e-12);
  }
}

TEST(AdjustEdge, KeepsItsAxesAcrossAndItsTangentOnTheSideOfTheStart) {
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    SpaceEdge start = Start(random);
    if (trial % 2 == 1) start.tangent = -start.tangent;
    const EdgeEstimate estimate = AdjustEdge(
        start, MeasureAll(RingOfViews(8), kSigmaPx, random), kSigmaPx);
    EXPECT_GT(estimate.edge.tangent.dot(start.tangent), 0.9);
    Eigen::Matrix3d axes;
    axes << estimate.across, estimate.edge.tangent;
    EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(),
              1e-9);
  }
}

// Means over many trials of the scatter of the estimate and of the covariance
// that it states, on one pair of axes across the true tangent.
struct Scatter {
  Matrix2d actual = Matrix2d::Zero();
  Matrix2d stated = Matrix2d::Zero();
};

Scatter MeasureScatter(const std::vector<PosedView>& views,
                       double noise_px,
                       int num_trials) {
  Random random(4);
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = kTruth.tangent.unitOrthogonal();
  axes.col(1) = kTruth.tangent.cross(axes.col(0));
  Scatter scatter;
  for (int trial = 0; trial < num_trials; ++trial) {
    const EdgeEstimate estimate =
        AdjustRepeatedly(Start(random), MeasureAll(views, noise_px, random));
    const Vector2d error =
        axes.transpose() * (estimate.edge.position - kTruth.position);
    scatter.actual += error * error.transpose() / num_trials;
    const Matrix2d turn = axes.transpose() * estimate.across;
    scatter.stated +=
        turn * estimate.covariance * turn.transpose() / num_trials;
  }
  return scatter;
}

TEST(AdjustEdge, StatesTheScatterOfItsErrors) {
  for (const int num_views : {8, 20}) {
    const Scatter scatter =
        MeasureScatter(RingOfViews(num_views), kSigmaPx, 2000);
    for (const Vector2d& axis :
         {Vector2d(1, 0), Vector2d(0, 1), Vector2d(1, 1).normalized()}) {
      const double actual = std::sqrt(axis.dot(scatter.actual * axis));
      const double stated = std::sqrt(axis.dot(scatter.stated * axis));
      EXPECT_NEAR(stated / actual, 1, 0.2) << num_views << " views";
    }
  }
}

TEST(AdjustEdge, StatesMoreWhereTheEdgesScatterMore) {
  const auto views = RingOfViews(20);
  const Scatter little = MeasureScatter(views, kSigmaPx, 300);
  const Scatter much = MeasureScatter(views, 4 * kSigmaPx, 300);
  EXPECT_GT(much.stated.trace(), 2 * little.stated.trace());
}

TEST(AdjustEdge, IsHardlyMovedByAnOutlier) {
  Random random(5);
  const auto views = RingOfViews(12);
  for (int trial = 0; trial < 50; ++trial) {
    auto measurements = MeasureAll(views, kSigmaPx, random);
    const EdgeEstimate without = AdjustEdge(kTruth, measurements, kSigmaPx);
    measurements.push_back(Measure(views[1], kTruth, 20 * kSigmaPx, 0));
    const EdgeEstimate with = AdjustEdge(kTruth, measurements, kSigmaPx);
    // Less than the standard deviation of the estimate itself.
    EXPECT_LT((with.edge.position - without.edge.position).norm(),
              std::sqrt(without.covariance.trace()));
  }
}

TEST(AdjustEdge, StaysNearTheStartWherePlanesHardlyDiffer) {
  const PosedView view1 = LookAt({6, 0, 0}, {0, 0, 0});
  const PosedView view2 = LookAt({6, 0.001, 0}, {0, 0, 0});
  const EdgeEstimate estimate =
      AdjustEdge(kTruth,
                 {Measure(view1, kTruth, 0.1, 0), Measure(view2, kTruth, 0, 0)},
                 kSigmaPx);
  ASSERT_TRUE(estimate.edge.position.allFinite());
  ASSERT_TRUE(estimate.covariance.allFinite());
  // A residual of 0.1 px is 0.75 thousandths here, across the line of sight.
  EXPECT_LT((estimate.edge.position - kTruth.position).norm(), 0.05);
  EXPECT_LT(estimate.edge.tangent.cross(kTruth.tangent).norm(), 0.01);
  Eigen::SelfAdjointEigenSolver<Matrix2d> axes;
  axes.computeDirect(estimate.covariance);
  EXPECT_GT(axes.eigenvalues()(1), 100 * axes.eigenvalues()(0));
}

// The largest angle, in degrees, between true and adjusted directions of an
// edge along the baseline, by images in which it is turned by up to 2 degrees.
double WorstAngleAlongTheBaseline(double ray_weight) {
  Random random(7);
  const SpaceEdge truth{{0, 0, 0}, {0, 1, 0}};
  double worst_cosine = 1;
  for (int trial = 0; trial < 100; ++trial) {
    const EdgeEstimate estimate = AdjustEdge(
        truth, MeasureAlongTheBaseline(truth, 2, random), kSigmaPx, ray_weight);
    worst_cosine =
        std::min(worst_cosine, estimate.edge.tangent.dot(truth.tangent));
  }
  return RadToDeg(std::acos(worst_cosine));
}

TEST(AdjustEdge, PrefersDirectionsAcrossTheRaysWherePlanesHardlyDiffer) {
  EXPECT_GT(WorstAngleAlongTheBaseline(0), 30);
  EXPECT_LT(WorstAngleAlongTheBaseline(0.05), 10);
}

TEST(AdjustEdge, HardlyPrefersAnyDirectionWherePlanesDiffer) {
  Random random(8);
  const auto measurements = MeasureAll(RingOfViews(8), 0, random);
  const EdgeEstimate estimate =
      AdjustEdge(Start(random), measurements, kSigmaPx, 0.05);
  EXPECT_LT(estimate.edge.tangent.cross(kTruth.tangent).norm(),
            std::sin(DegToRad(2)));
}

TEST(AdjustEdge, StatesTheScatterOfTheEdgeInAnotherView) {
  Random random(6);
  const auto all = RingOfViews(12);
  const std::vector<PosedView> views(all.begin(), all.begin() + 8);
  const PosedView other = LookAt({1, 5, -3}, {0, 0, 0});
  const ImageEdge expected = *ProjectEdge(other, kTruth);
  const Vector2d normal(-expected.tangent.y(), expected.tangent.x());
  const int num_trials = 2000;
  double actual = 0, predicted = 0;
  for (int trial = 0; trial < num_trials; ++trial) {
    const EdgeEstimate estimate =
        AdjustRepeatedly(Start(random), MeasureAll(views, kSigmaPx, random));
    const ImageEdge projected = *ProjectEdge(other, estimate.edge);
    const double error = normal.dot(projected.position - expected.position);
    actual += error * error / num_trials;
    const auto slope = [&](const Vector3d& axis) {
      const Vector3d h = 1e-5 * axis;
      const Vector3d& x = estimate.edge.position;
      return normal.dot(other.Pixel(other.InCamera(x + h)) -
                        other.Pixel(other.InCamera(x - h))) /
             2e-5;
    };
    const Vector2d gradient(slope(estimate.across.col(0)),
                            slope(estimate.across.col(1)));
    predicted += gradient.dot(estimate.covariance * gradient) / num_trials;
  }
  EXPECT_NEAR(std::sqrt(predicted / actual), 1, 0.2);
}

}  // namespace
}  // namespace curvix
