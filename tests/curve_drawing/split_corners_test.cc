// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/group_edges.h"

#include <gtest/gtest.h>
#include <cmath>
#include <vector>

#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

// Walks a pixel at a time and turns by so many degrees after each step.
Curve Walked(const std::vector<double>& turns_deg) {
  Curve curve;
  Eigen::Vector3d position(0, 0, 0);
  double angle = 0;
  for (const double turn_deg : turns_deg) {
    CurveSample sample;
    sample.position = position;
    sample.tangent = {std::cos(angle), std::sin(angle), 0};
    curve.samples.push_back(sample);
    position += kPx * sample.tangent;
    angle += turn_deg * 3.14159265358979 / 180;
  }
  return curve;
}

std::vector<double> NoTurns(std::size_t num_steps) {
  return std::vector<double>(num_steps, 0);
}

std::vector<std::size_t> PieceSizes(const std::vector<Curve>& curves) {
  std::vector<std::size_t> sizes;
  for (const Curve& curve : SplitCorners(curves, RingOfViews(8), {})) {
    sizes.push_back(curve.samples.size());
  }
  return sizes;
}

TEST(SplitCorners, CutsASharpAndARoundedCornerOnce) {
  std::vector<double> sharp = NoTurns(60);
  sharp[29] = 60;
  std::vector<double> rounded = NoTurns(60);
  for (const std::size_t k : {28u, 29u, 30u, 31u}) rounded[k] = 15;
  for (const auto& turns : {sharp, rounded}) {
    const auto sizes = PieceSizes({Walked(turns)});
    ASSERT_EQ(sizes.size(), 2u);
    EXPECT_NEAR(static_cast<double>(sizes[0]), 30, 2);
    EXPECT_EQ(sizes[0] + sizes[1], 60u);
  }
}

TEST(SplitCorners, LeavesCirclesOfAnyRadius) {
  for (const double radius_px : {12.0, 30.0, 200.0}) {
    const double turn = 57.29578 / radius_px;
    EXPECT_EQ(PieceSizes({Walked(std::vector<double>(60, turn))}),
              std::vector<std::size_t>{60});
  }
}

TEST(SplitCorners, LeavesWavesWhole) {
  for (const double length_px : {40.0, 50.0, 60.0}) {
    for (const double amplitude_px : {2.0, 4.0, 5.0}) {
      // Of a sine, by the length along it.
      const double turn = 2 * 3.14159265358979 / length_px;
      std::vector<double> turns;
      double x = 0;
      double before = std::atan(amplitude_px * turn);
      while (turns.size() < 150) {
        x += std::cos(before);
        const double angle =
            std::atan(amplitude_px * turn * std::cos(turn * x));
        turns.push_back(57.29578 * (angle - before));
        before = angle;
      }
      EXPECT_EQ(PieceSizes({Walked(turns)}), std::vector<std::size_t>{150})
          << length_px << " " << amplitude_px;
    }
  }
}

TEST(SplitCorners, OpensAPolygonIntoItsSides) {
  std::vector<double> hexagon = NoTurns(180);
  for (std::size_t k = 29; k < 180; k += 30) hexagon[k] = 60;
  Curve curve = Walked(hexagon);
  curve.closed = true;
  const auto pieces = SplitCorners({curve}, RingOfViews(8), {});
  ASSERT_EQ(pieces.size(), 6u);
  for (const Curve& piece : pieces) {
    EXPECT_FALSE(piece.closed);
    EXPECT_NEAR(static_cast<double>(piece.samples.size()), 30, 2);
  }
}

TEST(SplitCorners, LeavesWhatHasNoArmsAndWhatItIsToldToLeave) {
  EXPECT_TRUE(PieceSizes({}).empty());
  EXPECT_EQ(PieceSizes({Walked({90, 90, 90})}), std::vector<std::size_t>{3});
  std::vector<double> sharp = NoTurns(60);
  sharp[29] = 90;
  ConnectivityOptions options;
  options.max_corner_deg = 180;
  EXPECT_EQ(SplitCorners({Walked(sharp)}, RingOfViews(8), options).size(), 1u);
}

}  // namespace
}  // namespace curvix
