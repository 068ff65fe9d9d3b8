// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "evaluation/evaluate.h"
#include "plugin/commands/evaluations.h"
#include "tests/evaluation/true_line.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr CurveKind kUnknown = CurveKind::kUnknown;
constexpr CurveKind kCrease = CurveKind::kCrease;
constexpr CurveKind kBoundary = CurveKind::kBoundary;
constexpr CurveKind kMarking = CurveKind::kMarking;
constexpr CurveKind kContour = CurveKind::kOccludingContour;

// The segment from (0, y, 0) to (1, y, 0).
void AddTrueMetre(double y, CurveKind kind, int num_views, GroundTruth& truth) {
  const int id = static_cast<int>(truth.samples.size());
  AddTrueLine({0, y, 0}, {1, y, 0}, id, num_views, truth, kind);
  truth.has_kinds |= kind != kUnknown;
}

// A metre each of a crease, a boundary and a marking.
GroundTruth ThreeLines() {
  GroundTruth truth;
  AddTrueMetre(0, kCrease, 9, truth);
  AddTrueMetre(1, kBoundary, 9, truth);
  AddTrueMetre(2, kMarking, 9, truth);
  return truth;
}

// From (from, y, 0) to (to, y, 0).
Curve LineOfKind(double y, double from, double to, CurveKind kind) {
  Curve curve;
  for (const double x : {from, to}) {
    CurveSample& sample = curve.samples.emplace_back();
    sample.position = {x, y, 0};
    sample.kind = kind;
  }
  return curve;
}

KindAgreement Kinds(const std::vector<Curve>& curves,
                    const GroundTruth& truth) {
  const auto evaluation = EvaluateCurves({curves}, truth, {});
  EXPECT_TRUE(evaluation.ok()) << evaluation.status().message();
  EXPECT_TRUE(evaluation->kinds.has_value());
  return *evaluation->kinds;
}

double Said(const TrueKind& kind, CurveKind said) {
  return kind.predicted_mm[static_cast<std::size_t>(said)];
}

TEST(EvaluateKinds, TheTruthItselfIsAllRight) {
  const KindAgreement kinds = Kinds({LineOfKind(0, 0, 1, kCrease),
                                     LineOfKind(1, 0, 1, kBoundary),
                                     LineOfKind(2, 0, 1, kMarking)},
                                    ThreeLines());
  EXPECT_NEAR(*kinds.right, 100, 1e-9);
  ASSERT_EQ(kinds.kinds.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const TrueKind& kind = kinds.kinds[i];
    EXPECT_EQ(kind.kind, (std::array{kCrease, kBoundary, kMarking}[i]));
    EXPECT_NEAR(kind.length_mm, 1000, 1e-6);
    EXPECT_NEAR(kind.visible_length_mm, 1000, 1e-6);
    EXPECT_NEAR(*kind.visible_recall_5, 100, 1e-9);
    EXPECT_NEAR(Said(kind, kind.kind), 1000, 1e-6);
    EXPECT_NEAR(*kind.right, 100, 1e-9);
  }
  for (const double length : kinds.elsewhere_mm) EXPECT_EQ(length, 0);
}

TEST(EvaluateKinds, LengthsGoWhereTheyAreAndAsTheyAreSaid) {
  const KindAgreement kinds = Kinds({LineOfKind(0, 0, 0.75, kCrease),
                                     LineOfKind(0, 0.75, 1, kMarking),
                                     LineOfKind(1, 0, 0.5, kUnknown),
                                     LineOfKind(2, 0, 0.5, kCrease),
                                     LineOfKind(2.5, 0, 0.3, kContour)},
                                    ThreeLines());
  const TrueKind& crease = kinds.kinds[0];
  EXPECT_NEAR(Said(crease, kCrease), 750, 1e-6);
  EXPECT_NEAR(Said(crease, kMarking), 250, 1e-6);
  EXPECT_NEAR(*crease.right, 75, 1e-6);
  EXPECT_NEAR(Said(kinds.kinds[1], kUnknown), 500, 1e-6);
  EXPECT_NEAR(*kinds.kinds[1].right, 0, 1e-9);
  // Two samples beyond the end of the half are within 5 mm of it.
  EXPECT_NEAR(*kinds.kinds[1].visible_recall_5, 100 * 252.0 / 500, 1e-9);
  EXPECT_NEAR(Said(kinds.kinds[2], kCrease), 500, 1e-6);
  EXPECT_NEAR(*kinds.right, 100 * 750.0 / 2000, 1e-6);
  EXPECT_NEAR(
      kinds.elsewhere_mm[static_cast<std::size_t>(kContour)], 300, 1e-6);
}

TEST(EvaluateKinds, AKindChangesHalfwayBetweenTwoSamples) {
  Curve curve = LineOfKind(0, 0, 1, kCrease);
  curve.samples[1].kind = kMarking;
  const KindAgreement kinds = Kinds({curve}, ThreeLines());
  EXPECT_NEAR(Said(kinds.kinds[0], kCrease), 500, 2);
  EXPECT_NEAR(Said(kinds.kinds[0], kMarking), 500, 2);
}

TEST(EvaluateKinds, TheNearerOfTwoTrueCurvesCounts) {
  GroundTruth truth;
  AddTrueMetre(0, kCrease, 9, truth);
  AddTrueMetre(0.004, kMarking, 9, truth);
  const KindAgreement kinds = Kinds({LineOfKind(0.0015, 0, 1, kCrease)}, truth);
  EXPECT_NEAR(Said(kinds.kinds[0], kCrease), 1000, 1e-6);
  EXPECT_EQ(Said(kinds.kinds[1], kCrease), 0);
  EXPECT_FALSE(kinds.kinds[1].right.has_value());
}

TEST(EvaluateKinds, WhatFewViewsSeeCountsInTheLengthAlone) {
  GroundTruth truth = ThreeLines();
  AddTrueMetre(3, kMarking, 2, truth);
  const KindAgreement kinds = Kinds({LineOfKind(2, 0, 1, kMarking)}, truth);
  EXPECT_NEAR(kinds.kinds[2].length_mm, 2000, 1e-6);
  EXPECT_NEAR(kinds.kinds[2].visible_length_mm, 1000, 1e-6);
  EXPECT_NEAR(*kinds.kinds[2].visible_recall_5, 100, 1e-9);
}

TEST(EvaluateKinds, TruthOfAnUnknownKindIsNeitherRightNorWrong) {
  GroundTruth truth = ThreeLines();
  AddTrueMetre(3, kUnknown, 9, truth);
  const KindAgreement kinds = Kinds(
      {LineOfKind(0, 0, 1, kCrease), LineOfKind(3, 0, 1, kCrease)}, truth);
  EXPECT_NEAR(*kinds.right, 100, 1e-9);
  EXPECT_EQ(kinds.kinds[0].kind, kUnknown);
  EXPECT_FALSE(kinds.kinds[0].right.has_value());
  EXPECT_NEAR(Said(kinds.kinds[0], kCrease), 1000, 1e-6);
}

TEST(EvaluateKinds, WithoutKindsInTheTruthThereAreNone) {
  GroundTruth truth;
  AddTrueMetre(0, kUnknown, 9, truth);
  const auto evaluation =
      EvaluateCurves({{LineOfKind(0, 0, 1, kCrease)}}, truth, {});
  EXPECT_FALSE(evaluation->kinds.has_value());
  EXPECT_THAT(EvaluationText(*evaluation, /*json=*/false),
              Not(HasSubstr("kind")));
  const auto json =
      nlohmann::json::parse(EvaluationText(*evaluation, /*json=*/true));
  EXPECT_TRUE(json.at("kinds").is_null());
}

TEST(EvaluateKinds, ArePrintedAsATableAndAsJson) {
  const auto evaluation = EvaluateCurves(
      {{LineOfKind(0, 0, 0.75, kCrease), LineOfKind(0, 0.75, 1, kMarking)}},
      ThreeLines(),
      {});
  const std::string table = EvaluationText(*evaluation, /*json=*/false);
  EXPECT_THAT(
      table,
      HasSubstr("true kind, mm              length   visible   recall\n"
                "crease                        1000      1000  100.000 %\n"));
  EXPECT_THAT(
      table,
      HasSubstr(
          "said to be, mm             unknown    crease  boundary   marking   "
          "contour    right\n"
          "crease                           0       750         0       250   "
          "      0   75.000 %\n"));
  EXPECT_THAT(table, HasSubstr("of the right kind          75.000 %\n"));
  const auto json =
      nlohmann::json::parse(EvaluationText(*evaluation, /*json=*/true))
          .at("kinds");
  EXPECT_NEAR(json.at("right").get<double>(), 75, 1e-6);
  EXPECT_NEAR(
      json.at("crease").at("said").at("marking").get<double>(), 250, 1e-6);
  EXPECT_NEAR(json.at("crease").at("length").get<double>(), 1000, 1e-6);
  EXPECT_NEAR(json.at("crease").at("Rv5").get<double>(), 100, 1e-6);
  EXPECT_TRUE(json.at("boundary").at("right").is_null());
  EXPECT_EQ(json.at("elsewhere").at("occluding_contour"), 0);
}

}  // namespace
}  // namespace curvix
