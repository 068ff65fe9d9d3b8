// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/fitting.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/angles.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/fitting/sampled_curves.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
// A frame that is along no axis.
const Eigen::Matrix3d kFrame =
    Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
const Vector3d kCenter(3, -1, 2);

Vector3d OnEllipse(double a, double b, double angle) {
  return kCenter +
         kFrame * Vector3d(a * std::cos(angle), b * std::sin(angle), 0);
}

CurveFit FitOne(const Curve& curve) {
  const FittedCurves fitted = Fit({curve});
  EXPECT_EQ(fitted.curves.at(0).fits.size(), 1u);
  return fitted.curves.at(0).fits.at(0);
}

TEST(FitCurves, FindsALine) {
  const Vector3d from(1, 2, 3), to(2, 1, 5);
  const CurveFit fit = FitOne(
      Sample([&](double t) { return Vector3d(from + t * (to - from)); }, 100));
  EXPECT_EQ(KindName(fit), "line");
  EXPECT_LT((fit.start - from).norm(), 5 * kSigma);
  EXPECT_LT((fit.end - to).norm(), 5 * kSigma);
  EXPECT_NEAR(Length(fit), (to - from).norm(), 5 * kSigma);
  // Errors in two directions across the line.
  EXPECT_NEAR(fit.rms_residual, std::sqrt(2) * kSigma, 0.3 * kSigma);
  EXPECT_GT(fit.inlier_share, 0.95);
}

// Samples on a helix about the line, off by nine tenths of sigma along each
// axis, root mean square.
TEST(FitCurves, FindsALineWhoseNeighbouringSamplesErrAlike) {
  const double radius = 0.9 * std::sqrt(2) * kSigma;
  const auto wave = [&](double t) {
    const double angle = 12 * kPi * t;
    return Vector3d(t, radius * std::cos(angle), radius * std::sin(angle));
  };
  EXPECT_EQ(KindName(FitOne(Sample(wave, 400, false, 0))), "line");
}

TEST(FitCurves, FindsAnArcAndItsRadius) {
  const CurveFit fit = FitOne(
      Sample([](double t) { return OnEllipse(0.5, 0.5, 0.3 + 1.5 * t); }, 120));
  EXPECT_EQ(KindName(fit), "arc");
  EXPECT_NEAR(fit.major.norm(), 0.5, 5 * fit.radius_sigma);
  EXPECT_LT(fit.radius_sigma, 2 * kSigma);
  EXPECT_LT((fit.center - kCenter).norm(), 5 * kSigma);
  EXPECT_NEAR(fit.end_angle - fit.start_angle, 1.5, 0.01);
  EXPECT_NEAR(Length(fit), 0.75, 0.01);
  EXPECT_LT((PointAt(fit, 0) - fit.start).norm(), 1e-9);
  EXPECT_LT((PointAt(fit, 1) - fit.end).norm(), 1e-9);
}

TEST(FitCurves, FindsACircleWhetherItsCurveIsClosedOrNot) {
  for (const bool closed : {true, false}) {
    const CurveFit fit =
        FitOne(Sample([](double t) { return OnEllipse(0.2, 0.2, 2 * kPi * t); },
                      150,
                      closed));
    EXPECT_EQ(KindName(fit), "circle");
    EXPECT_NEAR(fit.major.norm(), 0.2, 5 * fit.radius_sigma);
    EXPECT_NEAR(Length(fit), 0.4 * kPi, 0.005);
    EXPECT_EQ(fit.start, fit.end);
  }
}

// Curves in pixels of one view, whose last three pixels are bent aside.
std::string KindWithBentEnds(double length_px, double bow_px) {
  constexpr double kPixel = 0.01;  // 8 from a camera of focal length 800
  const Scene scene = ToScene({LookAt({8, 0, 0}, {0, 0, 0})});
  Curve curve;
  const int n = static_cast<int>(length_px) + 1;
  for (int i = 0; i < n; ++i) {
    const double t = 2.0 * i / (n - 1) - 1;
    const double to_end = std::min(i, n - 1 - i);
    const double bent = 0.1 * std::max(0.0, 3 - to_end);
    CurveSample& sample = curve.samples.emplace_back();
    sample.position =
        kPixel * Vector3d(0, t * length_px / 2, bow_px * (1 - t * t) + bent);
    sample.sigma = 0.03 * kPixel;
    sample.support = {{0, 0}};
  }
  const FittedCurves fitted = FitCurves({{curve}}, scene, {}, 1);
  return std::string(KindName(fitted.curves.at(0).fits.at(0)));
}

TEST(FitCurves, TakesTheLastPixelsAsBent) {
  EXPECT_EQ(KindWithBentEnds(12, 0), "line");
  EXPECT_EQ(KindWithBentEnds(30, 0), "line");
  EXPECT_EQ(KindWithBentEnds(30, 2), "arc");
}

// Edges that all lie a tenth of a pixel inside make a circle too small, however
// many they are.
TEST(FitCurves, KnowsThatErrorsOfBentCurvesAreShared) {
  constexpr double kPixel = 0.01;
  constexpr double kShared = 0.1 * kPixel;
  const Scene scene = ToScene({LookAt({8, 0, 0}, {0, 0, 0})});
  for (const int n : {100, 1000}) {
    Curve curve;
    curve.closed = true;
    for (int i = 0; i < n; ++i) {
      const double t = 2 * kPi * i / n;
      CurveSample& sample = curve.samples.emplace_back();
      sample.position = (0.5 - kShared) * Vector3d(0, std::cos(t), std::sin(t));
      sample.sigma = 0.03 * kPixel;
      sample.support = {{0, 0}};
    }
    const FittedCurves fitted = FitCurves({{curve}}, scene, {}, 1);
    const CurveFit& fit = fitted.curves.at(0).fits.at(0);
    EXPECT_EQ(KindName(fit), "circle");
    EXPECT_NEAR(fit.major.norm(), 0.5, 1.1 * fit.radius_sigma);
    EXPECT_NEAR(fit.radius_sigma, kShared, 0.1 * kShared);
    EXPECT_NEAR(fit.sigma, kShared, 0.1 * kShared);
  }
}

TEST(FitCurves, KeepsACircleWhoseEndsAreBent) {
  Curve curve =
      Sample([](double t) { return OnEllipse(0.2, 0.2, 6 * t); }, 100);
  for (std::size_t i = 0; i < 5; ++i) {
    curve.samples[99 - i].position +=
        kFrame * Vector3d(0, 0, 0.05 - 0.01 * static_cast<double>(i));
  }
  const CurveFit fit = FitOne(curve);
  EXPECT_EQ(fit.kind, FitKind::kArc);
  EXPECT_NEAR(fit.major.norm(), 0.2, kSigma);
  EXPECT_NEAR(fit.inlier_share, 0.95, 0.03);
}

TEST(FitCurves, FindsAnEllipse) {
  for (const double sweep : {2 * kPi, 3.0}) {
    const bool closed = sweep > 6;
    const CurveFit fit = FitOne(Sample(
        [&](double t) { return OnEllipse(0.6, 0.3, sweep * t); }, 200, closed));
    EXPECT_EQ(KindName(fit), "ellipse") << sweep;
    EXPECT_EQ(fit.closed, closed);
    EXPECT_NEAR(fit.major.norm(), 0.6, 3 * kSigma);
    EXPECT_NEAR(fit.minor.norm(), 0.3, 3 * kSigma);
    EXPECT_NEAR(fit.major.dot(fit.minor), 0, 1e-9);
  }
}

TEST(FitCurves, TakesASplineForWhatIsNothingElse) {
  const auto helix = [](double t) {
    return Vector3d(std::cos(9 * t), std::sin(9 * t), 2 * t);
  };
  const CurveFit fit = FitOne(Sample(helix, 400));
  EXPECT_EQ(KindName(fit), "spline");
  EXPECT_EQ(fit.knots.size(), fit.control_points.size() + 4);
  EXPECT_LT((PointAt(fit, 0) - helix(0)).norm(), 5 * kSigma);
  EXPECT_LT((PointAt(fit, 1) - helix(1)).norm(), 5 * kSigma);
  EXPECT_LT(fit.rms_residual, 2 * kSigma);
  EXPECT_NEAR(Length(fit), std::hypot(9, 2), 0.02);
}

// A slot: two lines and two half circles.
Vector3d OnSlot(double t) {
  const double straight = 1, radius = 0.3;
  const double around = 2 * straight + 2 * kPi * radius;
  double s = t * around;
  Vector3d p;
  if (s < straight) {
    p = {s - straight / 2, -radius, 0};
  } else if ((s -= straight) < kPi * radius) {
    const double angle = s / radius - kPi / 2;
    p = {straight / 2 + radius * std::cos(angle), radius * std::sin(angle), 0};
  } else if ((s -= kPi * radius) < straight) {
    p = {straight / 2 - s, radius, 0};
  } else {
    const double angle = (s - straight) / radius + kPi / 2;
    p = {-straight / 2 + radius * std::cos(angle), radius * std::sin(angle), 0};
  }
  return kCenter + kFrame * p;
}

TEST(FitCurves, TakesASlotToPiecesThatMeet) {
  const FittedCurves fitted = Fit({Sample(OnSlot, 600, true)});
  const std::vector<CurveFit>& fits = fitted.curves[0].fits;
  ASSERT_EQ(fits.size(), 4u);
  EXPECT_EQ(fitted.nodes.size(), 4u);
  int num_lines = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const CurveFit& next = fits[(i + 1) % 4];
    EXPECT_NE(fits[i].kind, next.kind);
    EXPECT_EQ(fits[i].end, next.start);
    EXPECT_EQ(fits[i].end_node, next.start_node);
    if (fits[i].kind == FitKind::kLine) {
      ++num_lines;
      EXPECT_NEAR(Length(fits[i]), 1, 0.06);
    } else {
      EXPECT_NEAR(fits[i].major.norm(), 0.3, 3 * kSigma);
      EXPECT_LT((PointAt(fits[i], 0) - fits[i].start).norm(), 0.1 * kSigma);
      EXPECT_LT((PointAt(fits[i], 1) - fits[i].end).norm(), 0.1 * kSigma);
    }
  }
  EXPECT_EQ(num_lines, 2);
}

// Three lines from `corner` along the axes, whose first samples are at `end`.
std::vector<Curve> AxesFrom(const Vector3d& corner, const Vector3d& end) {
  std::vector<Curve> curves;
  for (int axis = 0; axis < 3; ++axis) {
    Curve& curve = curves.emplace_back(Sample(
        [&](double t) { return Vector3d(corner + t * Vector3d::Unit(axis)); },
        80));
    curve.samples.front().position = end;
  }
  return curves;
}

TEST(FitCurves, LetsLinesMeetWhereTheyCrossNotWhereTheirEndsWere) {
  const Vector3d corner(1, 1, 1);
  // All ends in one place, five standard deviations off.
  const std::vector<Curve> curves =
      AxesFrom(corner, corner + Vector3d::Constant(3 * kSigma));
  const FittedCurves fitted = Fit(curves);
  ASSERT_EQ(fitted.nodes.size(), 1u);
  EXPECT_EQ(fitted.nodes[0].ends.size(), 3u);
  EXPECT_LT((fitted.nodes[0].position - corner).norm(), kSigma);
  for (const FittedCurve& curve : fitted.curves) {
    ASSERT_THAT(Kinds(curve), ElementsAre("line"));
    EXPECT_EQ(curve.fits[0].start, fitted.nodes[0].position);
    EXPECT_EQ(curve.fits[0].start_node, 0);
    EXPECT_EQ(curve.fits[0].end_node, -1);
  }
}

TEST(FitCurves, LeavesALineFreeThatMissesTheOthers) {
  const Vector3d corner(1, 1, 1);
  std::vector<Curve> curves = AxesFrom(corner, corner);
  const Vector3d aside = 30 * kSigma * Vector3d(1, 1, 0);
  for (std::size_t i = 1; i < curves[2].samples.size(); ++i) {
    curves[2].samples[i].position += aside;
  }
  const FittedCurves fitted = Fit(curves);
  ASSERT_EQ(fitted.nodes.size(), 1u);
  EXPECT_EQ(fitted.nodes[0].ends.size(), 2u);
  EXPECT_LT((fitted.nodes[0].position - corner).norm(), kSigma);
  const CurveFit& free = fitted.curves[2].fits.at(0);
  EXPECT_EQ(free.start_node, -1);
  EXPECT_LT((free.start - corner - aside).norm(), 2 * kSigma);
  EXPECT_GT(free.inlier_share, 0.9);
}

TEST(FitCurves, FollowsARigidMotion) {
  const Curve curve = Sample(OnSlot, 300, true);
  const Eigen::AngleAxisd turn(1.1, Vector3d(-1, 3, 2).normalized());
  Curve moved = curve;
  for (CurveSample& s : moved.samples) {
    s.position = turn * s.position + Vector3d(5, 6, 7);
  }
  const FittedCurve a = Fit({curve}).curves[0], b = Fit({moved}).curves[0];
  ASSERT_EQ(Kinds(a), Kinds(b));
  for (std::size_t i = 0; i < a.fits.size(); ++i) {
    const Vector3d expected = turn * a.fits[i].start + Vector3d(5, 6, 7);
    EXPECT_LT((b.fits[i].start - expected).norm(), 0.1 * kSigma);
  }
}

TEST(FitCurves, TakesCurvesOfTwoSamplesAndOfNoLength) {
  Curve two = Sample([](double t) { return Vector3d(t, 0, 0); }, 2);
  Curve none = Sample([](double) { return Vector3d(1, 1, 1); }, 8, false, 0);
  none.samples.resize(8);
  const FittedCurves fitted = Fit({two, none});
  EXPECT_THAT(Kinds(fitted.curves[0]), ElementsAre("line"));
  ASSERT_EQ(fitted.curves[1].fits.size(), 1u);
  EXPECT_TRUE(fitted.curves[1].fits[0].start.allFinite());
  EXPECT_TRUE(Fit({}).curves.empty());
}

TEST(FitCurves, NeedsNoSigma) {
  Curve curve = Sample(
      [](double t) { return OnEllipse(1, 1, 2 * t); }, 100, false, 0.0001);
  for (CurveSample& s : curve.samples) s.sigma = 0;
  EXPECT_EQ(KindName(FitOne(curve)), "arc");
}

// Two samples, as lines of other programs are.
TEST(FitCurves, TakesLinesOfNoSigmaAsKnownToAPixel) {
  constexpr double kPixel = 0.01;
  const Scene scene = ToScene({LookAt({8, 0, 0}, {0, 0, 0})});
  Curve curve;
  for (const double y : {-1, 1}) {
    CurveSample& sample = curve.samples.emplace_back();
    sample.position = Vector3d(0, y, 0);
    sample.tangent = Vector3d::UnitY();
    sample.support = {{0, 0}};
  }
  const FittedCurves fitted = FitCurves({{curve}}, scene, {}, 1);
  const CurveFit& fit = fitted.curves.at(0).fits.at(0);
  EXPECT_EQ(KindName(fit), "line");
  EXPECT_NEAR(std::sqrt(fit.start_covariance(2, 2)), kPixel, 0.2 * kPixel);
}

TEST(FitCurves, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Curve> curves = {
      Sample(OnSlot, 300, true),
      Sample([](double t) { return OnEllipse(1, 1, t); }, 50),
      Sample([](double t) { return OnEllipse(2, 1, 2 * t); }, 90)};
  const FittedCurves one = Fit(curves, 1), three = Fit(curves, 3);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    ASSERT_EQ(Kinds(one.curves[i]), Kinds(three.curves[i]));
    for (std::size_t f = 0; f < one.curves[i].fits.size(); ++f) {
      EXPECT_EQ(one.curves[i].fits[f].start, three.curves[i].fits[f].start);
      EXPECT_EQ(one.curves[i].fits[f].sigma, three.curves[i].fits[f].sigma);
    }
  }
}

}  // namespace
}  // namespace curvix
