// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/choose_dimensions.h"

#include <string>

#include "drawing/flat_fit.h"
#include "gtest/gtest.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// As the front shows it, with both ends known to 0.02.
std::optional<MeasuredDimension> OfLine(const Vector3d& start,
                                        const Vector3d& end,
                                        double scale_sigma = 0) {
  CurveFit line;
  line.start = start;
  line.end = end;
  line.start_node = 0;
  line.end_node = 1;
  line.start_covariance = line.end_covariance =
      4e-4 * Eigen::Matrix3d::Identity();
  const auto flat = FlatFit(line, *AxisPlane("xz"));
  if (!flat) return std::nullopt;
  return DimensionOf(line, *flat, scale_sigma);
}

TEST(DimensionOf, WritesWhatIsKnown) {
  const auto length = OfLine({0, 0, 0}, {60, 0, 0});
  ASSERT_TRUE(length.has_value());
  EXPECT_EQ(length->drawn.text, "60.00");
  EXPECT_NEAR(length->sigma, 0.0283, 1e-4);
  EXPECT_EQ(OfLine({0, 0, 0}, {60, 0, 0}, 0.01)->drawn.text, "60.0");
  CurveFit circle;
  circle.kind = FitKind::kArc;
  circle.closed = true;
  circle.major = {12.5, 0, 0};
  circle.minor = {0, 0, 12.5};
  circle.end_angle = 6.283185307179586;
  circle.start = circle.end = {12.5, 0, 0};
  circle.radius_sigma = 0.2;
  const auto flat = FlatFit(circle, *AxisPlane("xz"));
  ASSERT_TRUE(flat.has_value());
  EXPECT_EQ(DimensionOf(circle, *flat, 0)->drawn.text, "R12.5");
}

TEST(DimensionOf, NothingThatEndsNowhere) {
  CurveFit line;
  line.end = {60, 0, 0};
  line.start_covariance = Eigen::Matrix3d::Identity();
  EXPECT_FALSE(DimensionOf(line, line, 0).has_value());
  line.start_node = 0;
  EXPECT_FALSE(DimensionOf(line, line, 0).has_value());
  line.end_node = 1;
  EXPECT_TRUE(DimensionOf(line, line, 0).has_value());
}

TEST(DimensionOf, NothingThatTheDrawingShortens) {
  EXPECT_TRUE(OfLine({0, 0, 0}, {60, 1, 0}).has_value());
  EXPECT_FALSE(OfLine({0, 0, 0}, {60, 6, 0}).has_value());
}

TEST(ChooseDimensions, EqualOnesOnceAndTheOutermost) {
  const auto inner = OfLine({0, 0, 10}, {60, 0, 10});
  const auto outer = OfLine({0, 0, 90}, {60.01, 0, 90});
  const auto across = OfLine({0, 0, 0}, {0, 0, 60});
  const auto chosen = ChooseDimensions({*inner, *outer, *across});
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[0].a.y(), 90);
  EXPECT_EQ(chosen[1].a.y(), 0);
}

}  // namespace
}  // namespace curvix
