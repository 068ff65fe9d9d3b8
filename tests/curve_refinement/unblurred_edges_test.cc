// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/response_curve.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/curve_refinement/drawn_curves.h"
#include "tests/edge_detection/oriented_edges.h"
#include "tests/support/picture.h"

namespace curvix {
namespace {

constexpr double kBlurPx = 1.2;
constexpr double kWholeTurn = 2 * std::numbers::pi;

// A view of 64 x 64 pixels that looks at the origin of the plane.
PosedView SmallView() {
  PosedView view = FrontalViews()[0];
  view.width = view.height = 64;
  view.calibration(0, 2) = view.calibration(1, 2) = 32;
  return view;
}

const Eigen::Vector2d kCenter(32, 32);

double RadiusOf(const Eigen::Vector2d& position) {
  return (position - kCenter).norm();
}

// The edge at the first sample of Arc(radius_px, 0, ...), where blur draws it.
Edge2d BlurredEdge(double radius_px) {
  Edge2d edge;
  edge.position = kCenter;
  edge.position.x() += radius_px - kBlurPx * kBlurPx / (2 * radius_px);
  edge.angle = static_cast<float>(std::numbers::pi / 2);
  edge.sharpness = static_cast<float>(1 / (kBlurPx * kBlurPx));
  return edge;
}

// How far the edge moves if sample `index` of `curve` is the one it shows.
double ShiftOf(const Edge2d& edge, const Curve& curve, std::size_t index) {
  const auto bend = BendAround(curve, index, kPixel);
  return (Unblurred(edge, SmallView(), bend, {}, 0).position - edge.position)
      .norm();
}

TEST(UnblurredEdges, CirclesHaveTheirRadius) {
  for (const double radius_px : {4.0, 20.0, 100.0}) {
    const auto bend = BendAround(Arc(radius_px, 0, kWholeTurn), 0, kPixel);
    const ImageEdge edge =
        Unblurred(BlurredEdge(radius_px), SmallView(), bend, {}, 0);
    EXPECT_NEAR(RadiusOf(edge.position), radius_px, 1e-3);
  }
}

// There blur moves the edge less, so that less is left to undo.
TEST(UnblurredEdges, CirclesHaveTheirRadiusByTheFinerScale) {
  constexpr double kGainPx2 = 0.9;
  for (const double radius_px : {4.0, 20.0, 100.0}) {
    const auto bend = BendAround(Arc(radius_px, 0, kWholeTurn), 0, kPixel);
    Edge2d edge = BlurredEdge(radius_px);
    const double outward_px = kGainPx2 / (2 * radius_px);
    edge.fine_px = Eigen::half(static_cast<float>(-outward_px));
    EXPECT_NEAR(
        RadiusOf(Unblurred(edge, SmallView(), bend, {}, kGainPx2).position),
        radius_px,
        1e-3);
  }
}

TEST(UnblurredEdges, EndsBendLikeTheRest) {
  const Curve arc = Arc(10, 0, 2);
  const double expected = kBlurPx * kBlurPx / 20;
  for (const std::size_t index : {std::size_t{0}, arc.samples.size() - 1}) {
    EXPECT_NEAR(ShiftOf(BlurredEdge(10), arc, index), expected, 1e-3);
  }
}

TEST(UnblurredEdges, LinesStay) {
  const Curve line = Line(InPlane(10, -20), InPlane(10, 20));
  EXPECT_LT(ShiftOf(BlurredEdge(10), line, 20), 1e-9);
}

TEST(UnblurredEdges, EdgesOfUnknownSharpnessStay) {
  Edge2d edge = BlurredEdge(10);
  edge.sharpness = 0;
  EXPECT_EQ(ShiftOf(edge, Arc(10, 0, 2), 0), 0);
}

TEST(UnblurredEdges, TwoSamplesHaveNoBend) {
  const Curve line = Line(InPlane(10, 0), InPlane(11, 0));
  EXPECT_FALSE(BendAround(line, 0, kPixel));
  EXPECT_EQ(ShiftOf(BlurredEdge(10), line, 0), 0);
}

TEST(UnblurredEdges, SharpTurnsMoveThemLittle) {
  EXPECT_NEAR(ShiftOf(BlurredEdge(10), Arc(2, 0, kWholeTurn), 0), 0.25, 1e-9);
}

GrayImage SharpDisc(double radius_px) {
  return Picture(64, 64, [&](const Eigen::Vector2d& place) {
    return RadiusOf(place) < radius_px;
  });
}

std::size_t NearestSample(const Curve& curve, const Edge2d& edge) {
  const PosedView view = SmallView();
  const auto distance = [&](const CurveSample& sample) {
    return (view.Pixel(view.InCamera(sample.position)) - edge.position).norm();
  };
  const auto nearest = std::min_element(
      curve.samples.begin(), curve.samples.end(), [&](auto& a, auto& b) {
        return distance(a) < distance(b);
      });
  return static_cast<std::size_t>(nearest - curve.samples.begin());
}

TEST(UnblurredEdges, UndoesWhatTheDetectorDoesToDiscs) {
  for (const double radius_px : {5.0, 10.0, 20.0}) {
    const std::vector<Edge2d> edges =
        OrientedEdges(SharpDisc(radius_px), {}, 5);
    ASSERT_GT(edges.size(), 6 * radius_px);
    const Curve circle = Arc(radius_px, 0, kWholeTurn);
    double detected = 0, unblurred = 0;
    for (const Edge2d& edge : edges) {
      const auto bend = BendAround(circle, NearestSample(circle, edge), kPixel);
      detected += RadiusOf(edge.position);
      unblurred += RadiusOf(Unblurred(edge, SmallView(), bend, {}, 0).position);
    }
    const double count = static_cast<double>(edges.size());
    const double shrunk_px = radius_px - detected / count;
    EXPECT_GT(shrunk_px, 0.4 / radius_px);
    EXPECT_LT(std::abs(radius_px - unblurred / count), 0.3 * shrunk_px);
  }
}

// A step between two levels of brightness (0..1), blurred.
Edge2d EdgeOfStep(double dark, double bright) {
  Edge2d edge;
  edge.position = kCenter;
  edge.sharpness = static_cast<float>(1 / (kBlurPx * kBlurPx));
  edge.strength = static_cast<float>(
      255 * (bright - dark) / (std::sqrt(2 * std::numbers::pi) * kBlurPx));
  edge.level = Eigen::half(255 * (dark + bright) / 2);
  return edge;
}

TEST(ResponseShift, IsHalfTheContrastOverTheLevelAndOverTheRest) {
  const Eigen::Vector2d lever = ResponseShift(EdgeOfStep(0.2, 0.3));
  EXPECT_NEAR(lever[0], 0.05 / 0.25, 1e-6);
  EXPECT_NEAR(lever[1], 0.05 / 0.75, 1e-6);
}

TEST(ResponseShift, BlackAndWhiteSidesDoNotTellTheirLight) {
  EXPECT_EQ(ResponseShift(EdgeOfStep(0.5, 1)), Eigen::Vector2d::Zero());
  EXPECT_EQ(ResponseShift(EdgeOfStep(0, 0.5)), Eigen::Vector2d::Zero());
  EXPECT_NE(ResponseShift(EdgeOfStep(0.05, 0.95)), Eigen::Vector2d::Zero());
}

TEST(ResponseShift, EdgesOfUnknownSharpnessHaveNone) {
  Edge2d edge = EdgeOfStep(0.2, 0.3);
  edge.sharpness = 0;
  EXPECT_EQ(ResponseShift(edge), Eigen::Vector2d::Zero());
}

TEST(UnblurredEdges, ResponseMovesThemToTheBrightSide) {
  Edge2d edge = EdgeOfStep(0.2, 0.3);
  const ResponseCurve response = {{0.5, 0.3}};
  const double expected = ResponseShift(edge).dot(response.px);
  for (const double angle : {0.0, 2.0}) {
    edge.angle = static_cast<float>(angle);
    const Eigen::Vector2d to_bright(-std::sin(angle), std::cos(angle));
    const Eigen::Vector2d shift =
        Unblurred(edge, SmallView(), std::nullopt, response, 0).position -
        edge.position;
    EXPECT_LT((shift - expected * to_bright).norm(), 1e-6);
  }
}

// The mean distance of edges from a straight step, towards its bright side.
double MeanOffset(const std::vector<Edge2d>& edges,
                  const Eigen::Vector2d& to_bright,
                  const ResponseCurve& response) {
  double sum = 0;
  for (const Edge2d& edge : edges) {
    const ImageEdge unblurred =
        Unblurred(edge, SmallView(), std::nullopt, response, 0);
    sum += to_bright.dot(unblurred.position - kCenter);
  }
  return sum / static_cast<double>(edges.size());
}

TEST(UnblurredEdges, UndoesWhatAGammaDoesToSteps) {
  constexpr double kGamma = 2.2;
  const Eigen::Vector2d to_bright =
      Eigen::Vector2d(std::cos(0.3), std::sin(0.3));
  GrayImage image = Picture(64, 64, [&](const Eigen::Vector2d& place) {
    return to_bright.dot(place - kCenter) > 0;
  });
  for (float& pixel : image.pixels) {
    pixel = 240 * std::pow(pixel / 255, 1 / static_cast<float>(kGamma));
  }
  const std::vector<Edge2d> edges = OrientedEdges(image, {}, 5);
  ASSERT_GT(edges.size(), 60);
  // Light is I^gamma, so its slope goes with I^(gamma - 1). The blur counts by
  // half the mean distance of two points in it: 0.56 standard deviations of a
  // Gaussian, a sixth of a pixel.
  const double blur_px = 1.0 / 6;
  const ResponseCurve response = {{(kGamma - 1) * blur_px, 0}};
  const double detected_px = MeanOffset(edges, to_bright, {});
  EXPECT_LT(detected_px, -0.02);
  EXPECT_LT(std::abs(MeanOffset(edges, to_bright, response)),
            -0.15 * detected_px);
}

}  // namespace
}  // namespace curvix
