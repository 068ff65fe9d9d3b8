// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluate.h"
#include "plugin/commands/evaluations.h"
#include "tests/evaluation/true_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace curvix {
namespace {

using ::testing::HasSubstr;

Curve Polyline(const std::vector<Eigen::Vector3d>& points) {
  Curve curve;
  for (const Eigen::Vector3d& point : points) {
    CurveSample sample;
    sample.position = point;
    curve.samples.push_back(sample);
  }
  return curve;
}

// One true line along x, one metre long.
GroundTruth OneLine() {
  GroundTruth truth;
  AddTrueLine({0, 0, 0}, {1, 0, 0}, 0, 10, truth);
  return truth;
}

Evaluation Evaluate(std::vector<Curve> curves, const GroundTruth& truth) {
  CurveSet set;
  set.curves = std::move(curves);
  const auto evaluation = EvaluateCurves(set, truth, {});
  EXPECT_TRUE(evaluation.ok()) << evaluation.status().message();
  return *evaluation;
}

TEST(EvaluateCurves, TheTruthItselfIsPerfect) {
  const Evaluation e =
      Evaluate({Polyline({{0, 0, 0}, {0.3, 0, 0}, {1, 0, 0}})}, OneLine());
  EXPECT_EQ(e.num_predicted, 500u);
  EXPECT_NEAR(*e.accuracy_mm, 0, 1e-9);
  EXPECT_NEAR(*e.completeness_mm, 0, 1e-9);
  for (const Agreement& a : e.agreement) {
    EXPECT_EQ(a.precision, 100);
    EXPECT_EQ(a.recall, 100);
    EXPECT_NEAR(a.f_score, 100, 1e-9);
    EXPECT_EQ(a.iou, 100);
  }
  EXPECT_NEAR(*e.tangent_deg, 0, 1e-6);
  EXPECT_NEAR(*e.duplication, 1, 1e-9);
  EXPECT_EQ(e.whole, 100);
  EXPECT_EQ(e.pure, 100);
  EXPECT_EQ(e.num_curves, 1u);
  EXPECT_EQ(e.num_true_curves, 1u);
}

TEST(EvaluateCurves, AShiftIsTheDistance) {
  const Evaluation e =
      Evaluate({Polyline({{1, 0.007, 0}, {0, 0.007, 0}})}, OneLine());
  EXPECT_NEAR(*e.accuracy_mm, 7, 1e-9);
  EXPECT_NEAR(*e.completeness_mm, 7, 1e-9);
  EXPECT_EQ(e.agreement[0].f_score, 0);
  EXPECT_EQ(e.agreement[0].iou, 0);
  EXPECT_NEAR(e.agreement[1].f_score, 100, 1e-9);
  EXPECT_FALSE(e.tangent_deg.has_value());
  EXPECT_FALSE(e.duplication.has_value());
  EXPECT_EQ(e.whole, 0);
}

TEST(EvaluateCurves, HalfTheLineIsHalfTheRecall) {
  const Evaluation e =
      Evaluate({Polyline({{0, 0, 0}, {0.5, 0, 0}})}, OneLine());
  EXPECT_EQ(e.agreement[0].precision, 100);
  // Two samples beyond the end are still within 5 mm: 252 of 500.
  EXPECT_NEAR(e.agreement[0].recall, 100 * 252.0 / 500, 1e-9);
  EXPECT_NEAR(e.agreement[0].iou, 100 * 250.0 / (750 - 252), 1e-9);
  EXPECT_NEAR(*e.duplication, 250.0 / 252, 1e-9);
}

TEST(EvaluateCurves, ALineDrawnTwiceHasDuplicationTwo) {
  const Evaluation e = Evaluate({Polyline({{0, 0, 0}, {1, 0, 0}}),
                                 Polyline({{0, 0.001, 0}, {1, 0.001, 0}})},
                                OneLine());
  EXPECT_NEAR(*e.duplication, 2, 1e-9);
  EXPECT_EQ(e.whole, 100);
  EXPECT_EQ(e.num_curves, 2u);
  EXPECT_NEAR(e.agreement[0].iou, 100 * 500.0 / (1500 - 1000), 1e-9);
}

TEST(EvaluateCurves, ABrokenLineIsNotWhole) {
  const Evaluation e = Evaluate(
      {Polyline({{0, 0, 0}, {0.5, 0, 0}}), Polyline({{0.5, 0, 0}, {1, 0, 0}})},
      OneLine());
  EXPECT_EQ(e.whole, 0);
  EXPECT_EQ(e.agreement[0].recall, 100);
  EXPECT_EQ(e.pure, 100);
}

TEST(EvaluateCurves, ACurveAroundACornerIsAsPureAsItsLongerPart) {
  GroundTruth truth = OneLine();
  AddTrueLine({1, 0, 0}, {1, 0.25, 0}, 1, 10, truth);
  const Evaluation e =
      Evaluate({Polyline({{0, 0, 0}, {1, 0, 0}, {1, 0.25, 0}})}, truth);
  // Two or three samples at the corner are near both.
  EXPECT_NEAR(*e.pure, 80, 1);
  EXPECT_EQ(e.whole, 100);
  EXPECT_EQ(e.num_true_curves, 2u);
}

TEST(EvaluateCurves, TrueCurvesThatContinueEachOtherAreOne) {
  GroundTruth truth;
  AddTrueLine({0, 0, 0}, {0.502, 0, 0}, 3, 10, truth);
  AddTrueLine({1, 0, 0}, {0.5, 0, 0}, 8, 10, truth);
  const Evaluation e = Evaluate({Polyline({{0, 0, 0}, {1, 0, 0}})}, truth);
  EXPECT_EQ(e.num_true_curves, 1u);
  EXPECT_EQ(e.pure, 100);
}

TEST(EvaluateCurves, InvisibleSamplesCountOnlyInPlainRecall) {
  GroundTruth truth = OneLine();
  AddTrueLine({0, 1, 0}, {1, 1, 0}, 1, 3, truth);
  const Evaluation e = Evaluate({Polyline({{0, 0, 0}, {1, 0, 0}})}, truth);
  EXPECT_EQ(e.agreement[0].recall, 50);
  EXPECT_EQ(e.visible_recall_5, 100);
  EXPECT_NEAR(*e.visible_f_score_5, 100, 1e-9);
  EXPECT_NEAR(*e.visible_completeness_mm, 0, 1e-9);
  EXPECT_NEAR(*e.completeness_mm, 500, 1e-9);
  EXPECT_EQ(e.num_true_curves, 1u);
}

TEST(EvaluateCurves, TangentErrorIsUndirected) {
  const double slope = std::tan(0.2 * std::acos(-1.0) / 180);
  const Evaluation e =
      Evaluate({Polyline({{1, slope, 0}, {0, 0, 0}})}, OneLine());
  EXPECT_NEAR(*e.tangent_deg, 0.2, 1e-6);
}

TEST(EvaluateCurves, AClosedCurveIsSampledAllAround) {
  Curve square = Polyline({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_EQ(Evaluate({square}, OneLine()).num_predicted, 1500u);
  square.closed = true;
  EXPECT_EQ(Evaluate({square}, OneLine()).num_predicted, 2000u);
}

TEST(EvaluateCurves, SamplingDoesNotDependOnVertices) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= 1000; ++i) points.emplace_back(i / 1000.0, 0, 0);
  points.insert(points.begin() + 500, points[500]);
  EXPECT_EQ(Evaluate({Polyline(points)}, OneLine()).num_predicted, 500u);
}

TEST(EvaluateCurves, NothingFoundIsAnAnswer) {
  const Evaluation e = Evaluate({}, OneLine());
  EXPECT_EQ(e.agreement[0].f_score, 0);
  EXPECT_FALSE(e.accuracy_mm.has_value());
  EXPECT_EQ(e.num_curves, 0u);
}

TEST(EvaluateCurves, ColumnsThatAreMissingLeaveTheirMeasuresOut) {
  GroundTruth truth = OneLine();
  truth.has_tangents = truth.has_curve_ids = truth.has_views = false;
  for (TrueSample& sample : truth.samples) sample.num_views_edge = 0;
  const Evaluation e = Evaluate({Polyline({{0, 0, 0}, {1, 0, 0}})}, truth);
  EXPECT_FALSE(e.tangent_deg || e.duplication || e.whole || e.pure);
  EXPECT_EQ(e.visible_recall_5, e.agreement[0].recall);
}

TEST(EvaluateCurves, NothingFindsNothing) {
  GroundTruth truth = OneLine();
  truth.has_curve_ids = true;
  const Evaluation e = *EvaluateCurves({}, truth, {});
  EXPECT_EQ(e.visible_recall_5, 0);
  EXPECT_EQ(e.visible_f_score_5, 0);
  EXPECT_EQ(e.whole, 0);
}

TEST(EvaluateCurves, UnusableInputIsRefused) {
  CurveSet curves;
  curves.curves.push_back(Polyline({{0, 0, 0}, {1, 0, 0}}));
  const auto code = [&](const GroundTruth& truth, EvaluationOptions options) {
    return EvaluateCurves(curves, truth, options).status().code();
  };
  EvaluationOptions options;
  EXPECT_EQ(code({}, options), StatusCode::kInvalidArgument);
  for (const double step :
       {0.0, -1.0, 1e-12, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    options.step = step;
    EXPECT_EQ(code(OneLine(), options), StatusCode::kInvalidArgument) << step;
  }
  options = {};
  for (const double unit_mm : {0.0, std::numeric_limits<double>::infinity()}) {
    options.unit_mm = unit_mm;
    EXPECT_NE(EvaluateCurves({}, OneLine(), options)
                  .status()
                  .message()
                  .find("a finite number > 0"),
              std::string::npos)
        << unit_mm;
  }
}

TEST(EvaluationText, JsonHasNullForWhatIsAbsent) {
  const auto json = nlohmann::json::parse(
      EvaluationText(Evaluate({}, OneLine()), /*json=*/true));
  EXPECT_TRUE(json.at("acc").is_null());
  EXPECT_TRUE(json.at("gt_curves").is_null());
  EXPECT_EQ(json.at("F5"), 0);
  EXPECT_EQ(json.at("gt"), 500);
}

TEST(EvaluationText, TableIsAligned) {
  const std::string text =
      EvaluationText(Evaluate({Polyline({{0, 0, 0}, {1, 0, 0}})}, OneLine()),
                     /*json=*/false);
  EXPECT_THAT(text,
              HasSubstr("within                       5 mm    10 mm    20 mm\n"
                        "precision                 100.000  100.000  100.000 "
                        "%\n"));
  EXPECT_THAT(text, HasSubstr("accuracy                    0.000 mm\n"));
}

TEST(EvaluateFiles, MissingFilesAreNamed) {
  const Status status =
      EvaluateFiles("no_curves.ply", "no_truth.txt", {}, /*json=*/false)
          .status();
  EXPECT_EQ(status.code(), StatusCode::kNotFound);
  EXPECT_THAT(status.message(), HasSubstr("no_curves.ply"));
}

}  // namespace
}  // namespace curvix
