// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/drawn_views.h"

#include <cmath>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace curvix {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

CurveFit Line(const Vector3d& start, const Vector3d& end) {
  CurveFit line;
  line.start = start;
  line.end = end;
  return line;
}

TEST(DrawWindow, KeepsWhatIsInsideAndCutsAtItsEdges) {
  const auto window = ParseWindow("-1,3", "2,0,5,4");
  ASSERT_TRUE(window.ok()) << window.status().message();
  DrawingPlane plane = *AxisPlane("xz");
  plane.origin = {10, 0, 0};  // what is drawn at 2 is at x = 12
  const auto parts = [&](const Vector3d& a, const Vector3d& b) {
    return PartsInWindow(Line(a, b), plane, *window);
  };
  const auto inside = parts({12, 0, 1}, {14, 1, 3});
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_EQ(inside[0].start, Vector3d(12, 0, 1));
  EXPECT_EQ(inside[0].end, Vector3d(14, 1, 3));
  const auto cut = parts({10, 0, 1}, {18, 0, 5});
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_TRUE(cut[0].start.isApprox(Vector3d(12, 0, 2)));
  EXPECT_TRUE(cut[0].end.isApprox(Vector3d(15, 0, 3.5)));
  EXPECT_TRUE(parts({13, 4, 1}, {14, 5, 1}).empty());  // too deep
  EXPECT_TRUE(parts({16, 0, 1}, {17, 0, 1}).empty());  // beside
  EXPECT_TRUE(parts({13, 0, 5}, {13, 0, 6}).empty());  // above
}

TEST(DrawWindow, CutsACircleIntoItsArcs) {
  const auto window = ParseWindow("", "-9,-0.5,9,0.5");
  ASSERT_TRUE(window.ok());
  CurveFit circle;
  circle.kind = FitKind::kArc;
  circle.closed = true;
  circle.start_angle = 0;
  circle.end_angle = 6.283185307179586;
  circle.start = circle.end = {1, 0, 0};
  const auto arcs = PartsInWindow(circle, *AxisPlane("xy"), *window);
  ASSERT_EQ(arcs.size(), 2u);
  for (const CurveFit& arc : arcs) {
    EXPECT_NEAR(std::abs(arc.start.y()), 0.5, 1e-9);
    EXPECT_NEAR(std::abs(arc.end.y()), 0.5, 1e-9);
    EXPECT_LE(std::abs(PointAt(arc, 0.5).y()), 0.5);
  }
}

TEST(DrawWindow, SaysWhatItTakes) {
  for (const char* crop :
       {"1", "0,0,1", "0,0,1,2,3", "2,0,1,1", "0,2,1,1", "0,0,1,x"}) {
    const auto window = ParseWindow("", crop);
    ASSERT_FALSE(window.ok()) << crop;
    EXPECT_THAT(window.status().message(), HasSubstr("left, bottom, right"));
  }
  for (const char* slice : {"1", "2,1", "a,b"}) {
    EXPECT_FALSE(ParseWindow(slice, "").ok()) << slice;
  }
}

}  // namespace
}  // namespace curvix
