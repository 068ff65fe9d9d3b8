// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "synthetic/primitive.h"
#include "synthetic/scenes.h"
#include "synthetic/synthetic_truth.h"
#include "tests/synthetic/face_value.h"

namespace curvix {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

std::vector<double> SortedLengths(const std::vector<TrueCurve>& curves) {
  std::vector<double> lengths;
  for (const TrueCurve& curve : curves) lengths.push_back(curve.length);
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

SolidPrimitive Cube(double half, const Eigen::Vector3d& centre) {
  SolidPrimitive cube;
  cube.size.setConstant(half);
  cube.world_from_own.translation = centre;
  return cube;
}

SolidPrimitive Pin(double radius, double height) {
  SolidPrimitive pin;
  pin.shape = PrimitiveShape::kFrustum;
  pin.size = {radius, radius, height};
  return pin;
}

// Faces of the solid's primitives whose surface x lies on.
int NumFacesAt(const Solid& solid, const Eigen::Vector3d& x) {
  int num_faces = 0;
  for (const SolidPrimitive& primitive : solid.primitives()) {
    for (int face = 0; face < NumFaces(primitive.shape); ++face) {
      num_faces += std::abs(FaceValue(primitive, face, x)) < 1e-9;
    }
  }
  return num_faces;
}

class EverySolid : public ::testing::TestWithParam<SyntheticSolid> {};

TEST_P(EverySolid, HasCurvesOnTwoFacesWithTheirTangents) {
  const Solid solid = MakeSolid(GetParam(), 1);
  const std::vector<TrueCurve> curves = CreaseCurves(solid);
  ASSERT_FALSE(curves.empty());
  for (const TrueCurve& curve : curves) {
    for (int i = 0; i <= 20; ++i) {
      const double s = curve.length * i / 20;
      EXPECT_GE(NumFacesAt(solid, curve.Position(s)), 2);
      const double h = 1e-5;
      const Eigen::Vector3d difference =
          (curve.Position(s + h) - curve.Position(s - h)) / (2 * h);
      const double curvature = curve.radius > 0 ? 1 / curve.radius : 0;
      EXPECT_LT((difference - curve.Tangent(s)).norm(),
                1e-8 + std::pow(h * curvature, 2));
    }
  }
}

// Whether a curve passes within `tolerance` of x.
bool IsNear(const Eigen::Vector3d& x,
            const std::vector<TrueCurve>& curves,
            double tolerance) {
  for (const TrueCurve& curve : curves) {
    const double step = tolerance / 2;
    for (double s = 0; s <= curve.length; s += step) {
      if ((curve.Position(s) - x).norm() < tolerance) return true;
    }
  }
  return false;
}

// Rays that hit close together but on faces of different direction have an edge
// between them: none may be missing from the list.
TEST_P(EverySolid, HasACurveWhereverTheSurfaceTurnsSharply) {
  const Solid solid = MakeSolid(GetParam(), 1);
  const std::vector<TrueCurve> curves = CreaseCurves(solid);
  const Eigen::Vector3d step(0.006, 0.004, -0.005);
  int num_turns = 0;
  for (int i = 0; i < 5000; ++i) {
    const double z = 2 * (i + 0.5) / 5000 - 1;
    const double azimuth = 2.399963 * i;
    const double width = std::sqrt(1 - z * z);
    const Eigen::Vector3d eye =
        3 * Eigen::Vector3d(
                width * std::cos(azimuth), width * std::sin(azimuth), z);
    const Eigen::Vector3d target =
        0.3 *
        Eigen::Vector3d(std::sin(0.7 * i), std::sin(1.3 * i), std::sin(i));
    const auto a = solid.Trace({eye, target - eye});
    const auto b = solid.Trace({eye, target + step - eye});
    if (!a || !b) continue;
    if (a->primitive_idx == b->primitive_idx && a->face_idx == b->face_idx) {
      continue;  // round, but smooth
    }
    const Eigen::Vector3d at_a = eye + a->t * (target - eye);
    const Eigen::Vector3d at_b = eye + b->t * (target + step - eye);
    if ((at_a - at_b).norm() > 0.03 || a->normal.dot(b->normal) > 0.8) continue;
    ++num_turns;
    EXPECT_TRUE(IsNear(at_a, curves, 0.03)) << at_a.transpose();
  }
  EXPECT_GT(num_turns, 10);
}

INSTANTIATE_TEST_SUITE_P(Solids,
                         EverySolid,
                         ::testing::Values(SyntheticSolid::kBlock,
                                           SyntheticSolid::kCylinder,
                                           SyntheticSolid::kCone,
                                           SyntheticSolid::kSphere,
                                           SyntheticSolid::kPart,
                                           SyntheticSolid::kFacade,
                                           SyntheticSolid::kHouse,
                                           SyntheticSolid::kTable,
                                           SyntheticSolid::kKnobs,
                                           SyntheticSolid::kRoom));

TEST(CreaseCurvesTest, OfASheetThatStandsAreOneCreaseAndThreeBoundaries) {
  SolidPrimitive sheet = FlatSheet({-0.1, 0, 0.5}, {0.3, 0, 0}, {0, 0, 0.2});
  const Solid solid({Cube(0.5, {0, 0, 0}), sheet});
  std::vector<TrueCurve> boundaries;
  std::vector<TrueCurve> creases;
  for (const TrueCurve& curve : CreaseCurves(solid)) {
    (curve.kind == CurveKind::kBoundary ? boundaries : creases)
        .push_back(curve);
  }
  EXPECT_THAT(SortedLengths(boundaries),
              Pointwise(DoubleNear(1e-6), {0.2, 0.2, 0.3}));
  std::vector<double> expected = {0.3};
  expected.insert(expected.end(), 12, 1.0);
  EXPECT_THAT(SortedLengths(creases), Pointwise(DoubleNear(1e-8), expected));
}

TEST(CreaseCurvesTest, OfAFoldedCardHaveOneCreaseAtTheFold) {
  const Solid solid({Cube(0.5, {0, 0, 0}),
                     FlatSheet({-0.2, -0.1, 0.5}, {0.4, 0, 0}, {0, 0.1, 0.3}),
                     FlatSheet({-0.2, 0.1, 0.5}, {0.4, 0, 0}, {0, -0.1, 0.3})});
  double boundaries = 0;
  std::vector<TrueCurve> level;  // creases above the cube
  for (const TrueCurve& curve : CreaseCurves(solid)) {
    const bool is_crease = curve.kind == CurveKind::kCrease;
    if (!is_crease) boundaries += curve.length;
    if (is_crease && curve.origin.z() > 0.6) level.push_back(curve);
  }
  EXPECT_THAT(SortedLengths(level), ElementsAre(DoubleNear(0.4, 1e-6)));
  EXPECT_NEAR(boundaries, 4 * std::hypot(0.1, 0.3), 1e-4);
}

TEST(CreaseCurvesTest, OfASheetInABodyEndOnItsSurface) {
  SolidPrimitive sheet = FlatSheet({-0.1, 0, 0.3}, {0.3, 0, 0}, {0, 0, 0.5});
  double free_length = 0;
  for (const TrueCurve& curve :
       CreaseCurves(Solid({Cube(0.5, {0, 0, 0}), sheet}))) {
    if (curve.kind == CurveKind::kBoundary) free_length += curve.length;
  }
  EXPECT_NEAR(free_length, 0.3 + 2 * 0.3, 2e-5);
}

TEST(CreaseCurvesTest, OfACubeAreItsTwelveSides) {
  const Solid solid({Cube(0.5, {0.1, 0.2, 0.3})});
  EXPECT_THAT(SortedLengths(CreaseCurves(solid)),
              Pointwise(DoubleNear(1e-8), std::vector<double>(12, 1.0)));
}

TEST(CreaseCurvesTest, OfAPinAreItsTwoRims) {
  const std::vector<TrueCurve> curves = CreaseCurves(Solid({Pin(0.4, 1)}));
  EXPECT_THAT(SortedLengths(curves),
              ElementsAre(DoubleNear(2 * kPi * 0.4, 1e-12),
                          DoubleNear(2 * kPi * 0.4, 1e-12)));
  EXPECT_TRUE(curves[0].is_closed && curves[1].is_closed);
}

TEST(CreaseCurvesTest, OfFlushBodiesRunOnWithoutASeam) {
  const Solid solid({Cube(0.5, {0, 0, 0}), Cube(0.5, {0.4, 0, 0})});
  std::vector<double> expected(8, 1.0);
  expected.insert(expected.end(), 4, 1.4);
  EXPECT_THAT(SortedLengths(CreaseCurves(solid)),
              Pointwise(DoubleNear(1e-8), expected));
}

TEST(CreaseCurvesTest, OfAPinWithoutAQuarterAreArcsAndSegments) {
  SolidPrimitive quarter =
      Cube(0.5, {0.5, 0.5, 1});  // of the pin, above z = 0.5
  quarter.is_added = false;
  const Solid solid({Pin(0.3, 1), quarter});
  std::vector<double> arcs;
  std::vector<double> segments;
  int num_circles = 0;
  for (const TrueCurve& curve : CreaseCurves(solid)) {
    num_circles += curve.is_closed;
    if (curve.is_closed) continue;
    (curve.radius > 0 ? arcs : segments).push_back(curve.length);
  }
  std::sort(arcs.begin(), arcs.end());
  EXPECT_EQ(num_circles, 1);
  EXPECT_THAT(arcs,
              ElementsAre(DoubleNear(kPi / 2 * 0.3, 1e-7),
                          DoubleNear(3 * kPi / 2 * 0.3, 1e-7)));
  EXPECT_THAT(segments, ::testing::SizeIs(5));
}

}  // namespace
}  // namespace curvix
