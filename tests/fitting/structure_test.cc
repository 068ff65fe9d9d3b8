// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/fitting.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "measuring/moved_curves.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector3d;
constexpr double kPartSigma = 0.0005;
constexpr int kSteps = 60;

void Measure(Curve& curve, Random& random) {
  const std::size_t n = curve.samples.size();
  for (std::size_t i = 0; i < n; ++i) {
    CurveSample& s = curve.samples[i];
    s.sigma = kPartSigma;
    const bool is_junction = !curve.closed && (i == 0 || i + 1 == n);
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - s.tangent * s.tangent.transpose();
    if (!is_junction) s.position += kPartSigma * across * random.NormalVector();
  }
}

void AddLine(const Vector3d& from,
             const Vector3d& to,
             Random& random,
             CurveSet& set) {
  Curve& curve = set.curves.emplace_back();
  for (int i = 0; i <= kSteps; ++i) {
    CurveSample& s = curve.samples.emplace_back();
    s.position = from + i * (to - from) / kSteps;
    s.tangent = (to - from).normalized();
  }
  Measure(curve, random);
}

void AddCircle(const Vector3d& center,
               double radius,
               Random& random,
               CurveSet& set) {
  Curve& curve = set.curves.emplace_back();
  curve.closed = true;
  for (int i = 0; i < 2 * kSteps; ++i) {
    const double t = std::numbers::pi * i / kSteps;
    CurveSample& s = curve.samples.emplace_back();
    s.position = center + radius * Vector3d(std::cos(t), std::sin(t), 0);
    s.tangent = Vector3d(-std::sin(t), std::cos(t), 0);
  }
  Measure(curve, random);
}

// The edges of an L that is 0.4 high: 0 to 5 below, 6 to 11 above, 12 to 17
// upright; two rims of a hole of radius 0.2 around (0.5, 0.5), and a line that
// is askew.
CurveSet Part(std::uint64_t seed) {
  Random random(seed);
  const std::vector<Vector3d> corners = {
      {0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 1.5, 0}, {0, 1.5, 0}};
  const Vector3d up(0, 0, 0.4);
  CurveSet set;
  for (const double height : {0.0, 1.0}) {
    for (std::size_t i = 0; i < 6; ++i) {
      AddLine(corners[i] + height * up,
              corners[(i + 1) % 6] + height * up,
              random,
              set);
    }
  }
  for (const Vector3d& corner : corners) {
    AddLine(corner, corner + up, random, set);
  }
  AddCircle({0.5, 0.5, 0}, 0.2, random, set);
  AddCircle({0.5, 0.5, 0.4}, 0.2, random, set);
  AddLine({0.2, 0.1, 0.9}, {1.2, 0.5, 1.2}, random, set);
  return set;
}

FittedCurves FitPart(const CurveSet& set, bool regularize) {
  CurveFittingOptions options;
  options.regularize = regularize;
  return FitCurves(set, {}, options, 1);
}

// The curves of each group of a kind.
std::vector<std::vector<std::size_t>> Groups(const FitStructure& structure,
                                             GroupKind kind) {
  std::vector<std::vector<std::size_t>> groups;
  for (const FitGroup& group : structure.groups) {
    if (group.kind != kind) continue;
    auto& curves = groups.emplace_back();
    for (const FitIndex& i : group.fits) curves.push_back(i.curve_idx);
  }
  std::sort(groups.begin(), groups.end());
  return groups;
}

using testing::ElementsAre;
using testing::IsSupersetOf;

TEST(Structure, OfAPart) {
  const FitStructure structure = FitPart(Part(5), false).structure;
  EXPECT_THAT(Groups(structure, GroupKind::kParallel),
              ElementsAre(ElementsAre(0, 2, 4, 6, 8, 10),
                          ElementsAre(1, 3, 5, 7, 9, 11),
                          ElementsAre(12, 13, 14, 15, 16, 17, 18, 19)));
  EXPECT_EQ(structure.perpendicular.size(), 3u);
  EXPECT_THAT(Groups(structure, GroupKind::kConcentric),
              ElementsAre(ElementsAre(18, 19)));
  EXPECT_THAT(Groups(structure, GroupKind::kEqualRadius),
              ElementsAre(ElementsAre(18, 19)));
  EXPECT_THAT(Groups(structure, GroupKind::kCollinear), testing::IsEmpty());
  EXPECT_THAT(Groups(structure, GroupKind::kCoplanar),
              IsSupersetOf({std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 18},
                            std::vector<std::size_t>{6, 7, 8, 9, 10, 11, 19}}));
  const auto planes = Groups(structure, GroupKind::kCoplanar);
  EXPECT_EQ(std::ranges::adjacent_find(planes), planes.end()) << "twice";
  for (const FitGroup& group : structure.groups) {
    EXPECT_LT(group.chi_squared, 3 * group.degrees_of_freedom + 10);
  }
}

// Along a line, or the normal of an arc.
Vector3d Axis(const FittedCurves& fitted, const FitIndex& index) {
  const CurveFit& fit = fitted.curves[index.curve_idx].fits[index.fit_idx];
  return fit.kind == FitKind::kLine ? (fit.end - fit.start).normalized()
                                    : NormalOf(fit);
}

void ExpectHeld(const FittedCurves& fitted) {
  constexpr double kExact = 1e-7;
  const std::vector<FitGroup>& groups = fitted.structure.groups;
  EXPECT_GE(groups.size(), 6u);
  for (const FitGroup& group : groups) {
    const Vector3d axis = group.direction;
    for (const FitIndex& i : group.fits) {
      const CurveFit& fit = fitted.curves[i.curve_idx].fits[i.fit_idx];
      if (group.kind == GroupKind::kEqualRadius) {
        EXPECT_NEAR(fit.major.norm(), group.radius, kExact);
      } else if (group.kind == GroupKind::kCoplanar) {
        EXPECT_NEAR(axis.dot(fit.start - group.point), 0, kExact);
      } else {
        EXPECT_NEAR(Axis(fitted, i).cross(axis).norm(), 0, kExact);
      }
      if (group.kind == GroupKind::kConcentric) {
        EXPECT_NEAR((fit.center - group.point).cross(axis).norm(), 0, kExact);
      }
    }
  }
  for (const PerpendicularGroups& p : fitted.structure.perpendicular) {
    EXPECT_NEAR(
        groups[p.first].direction.dot(groups[p.second].direction), 0, kExact);
  }
}

class StructureInWorld : public testing::TestWithParam<Similarity3> {};

TEST_P(StructureInWorld, MovesWithTheWorld) {
  const Similarity3& s = GetParam();
  CurveSet moved;
  for (const Curve& curve : Part(5).curves) {
    moved.curves.push_back(MoveCurve(s, curve));
  }
  const FitStructure one = MoveFits(s, FitPart(Part(5), true)).structure;
  const FitStructure two = FitPart(moved, true).structure;
  ASSERT_EQ(one.groups.size(), two.groups.size());
  for (std::size_t g = 0; g < one.groups.size(); ++g) {
    const FitGroup& a = one.groups[g];
    const FitGroup& b = two.groups[g];
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.fits.size(), b.fits.size());
    EXPECT_NEAR(a.direction.cross(b.direction).norm(), 0, 1e-6);
    EXPECT_NEAR(a.sigma, b.sigma, 1e-3 * a.sigma);
    EXPECT_NEAR(a.radius, b.radius, 1e-4 * a.radius);
  }
}

TEST(Regularize, HoldsFarFromTheOrigin) {
  CurveSet moved = Part(5);
  for (Curve& curve : moved.curves) {
    for (CurveSample& s : curve.samples) s.position += Vector3d(5e5, 5e6, 100);
  }
  ExpectHeld(FitPart(moved, true));
}

Similarity3 World(double scale, const Vector3d& translation) {
  Similarity3 s;
  s.scale = scale;
  s.rotation = Eigen::Quaterniond(
      Eigen::AngleAxisd(0.8, Vector3d(1, 2, 3).normalized()));
  s.translation = translation;
  return s;
}

INSTANTIATE_TEST_SUITE_P(Worlds,
                         StructureInWorld,
                         testing::Values(World(70, {4, -5, 6}),
                                         World(1e-6, {0, 0, 0}),
                                         World(1e8, {0, 0, 0}),
                                         World(1e8, {3e9, -2e9, 1e9}),
                                         World(1, {5e5, 5e6, 100})),
                         [](const auto& world) {
                           return std::to_string(world.index);
                         });

// Lines so uncertain that nothing speaks against it are not parallel.
TEST(Structure, OfUncertainLinesIsNotFound) {
  CurveSet set;
  Random random(1);
  AddLine({0, 0, 0}, {1, 0, 0}, random, set);
  AddLine({0, 1, 0}, {1, 1.02, 0}, random, set);
  AddLine({0, 2, 0}, {0.99, 2, 0.03}, random, set);
  for (Curve& curve : set.curves) {
    for (CurveSample& s : curve.samples) s.sigma = 0.1;
  }
  EXPECT_TRUE(FitPart(set, false).structure.groups.empty());
}

double SumOfSquares(const FittedCurves& fitted) {
  double sum = 0;
  const double lengths[] = {2, 1, 1, 0.5, 1, 1.5};
  for (std::size_t i = 0; i < 18; ++i) {
    const double truth = i < 12 ? lengths[i % 6] : 0.4;
    sum += std::pow(Length(fitted.curves[i].fits[0]) - truth, 2);
  }
  for (const std::size_t i : {18u, 19u}) {
    sum += std::pow(fitted.curves[i].fits[0].major.norm() - 0.2, 2);
  }
  return sum;
}

TEST(Regularize, HoldsWhatWasFoundAndComesNearerToTheTruth) {
  double before = 0, after = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const FittedCurves free = FitPart(Part(seed), false);
    const FittedCurves fitted = FitPart(Part(seed), true);
    before += SumOfSquares(free);
    after += SumOfSquares(fitted);
    ExpectHeld(fitted);
    for (std::size_t n = 0; n < free.nodes.size(); ++n) {
      const Vector3d move = fitted.nodes[n].position - free.nodes[n].position;
      EXPECT_LE(move.dot(free.nodes[n].covariance.inverse() * move), 9.001);
      for (const CurveNode::End& end : fitted.nodes[n].ends) {
        const CurveFit& fit = fitted.curves[end.curve_idx].fits[end.fit_idx];
        EXPECT_EQ(end.at_end ? fit.end : fit.start, fitted.nodes[n].position);
      }
    }
  }
  EXPECT_LT(after, before);
}

}  // namespace
}  // namespace curvix
