// SPDX-License-Identifier: BSD-3-Clause
#include "io/curve_formats.h"

#include <curvix/curve_io.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <sstream>
#include <string>

#include "base/angles.h"
#include "base/file_io.h"
#include "tests/io/test_curves.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;

TEST(EncodeDxfDrawing, DeclaresTheUnitThatItKnows) {
  const TemporaryFolder folder;
  const auto written = [&](const char* unit) {
    const auto path = folder.path() / "a.dxf";
    EXPECT_TRUE(WriteDrawing(path, FittedCurves(), unit).ok());
    return *ReadFile(path);
  };
  EXPECT_THAT(written("mm"), HasSubstr("$INSUNITS\n70\n4\n"));
  EXPECT_THAT(written("ft"), HasSubstr("$INSUNITS\n70\n2\n"));
  EXPECT_THAT(written("rods"), HasSubstr("$INSUNITS\n70\n0\n"));
  EXPECT_THAT(written(""), HasSubstr("$INSUNITS\n70\n0\n"));
}

// The view that is shown first.
struct FirstView {
  Eigen::Vector2d center;
  double height = 0;
};

FirstView FirstViewOf(const FittedCurves& fitted) {
  const std::string dxf = Encoded(EncodeDxfDrawing, fitted, "m");
  std::istringstream lines(dxf.substr(dxf.find("*Active")));
  std::string code, value;
  std::getline(lines, value);
  FirstView view;
  while (std::getline(lines, code) && std::getline(lines, value)) {
    if (code == "0") break;
    if (code == "12") view.center.x() = std::stod(value);
    if (code == "22") view.center.y() = std::stod(value);
    if (code == "40") view.height = std::stod(value);
  }
  return view;
}

// A line from `start` to `end`, and a circle of radius 2 around `end` on which
// z is the same.
FittedCurves LineAndCircle(const Eigen::Vector3d& start,
                           const Eigen::Vector3d& end) {
  CurveFit line;
  line.start = start;
  line.end = end;
  CurveFit circle;
  circle.kind = FitKind::kArc;
  circle.closed = true;
  circle.center = end;
  circle.major = {2, 0, 0};
  circle.minor = {0, 2, 0};
  circle.end_angle = 2 * kPi;
  FittedCurves fitted;
  fitted.curves = {{{line}}, {{circle}}};
  return fitted;
}

TEST(EncodeDxfDrawing, ShowsAllCurvesFirst) {
  for (const double x : {0.0, -30.0, 4e6}) {
    const FirstView view =
        FirstViewOf(LineAndCircle({x, 500, 7}, {x + 6, 500, 90}));
    // x to x + 8, and 498 to 502.
    EXPECT_NEAR(view.center.x(), x + 4, 1e-6);
    EXPECT_NEAR(view.center.y(), 500, 1e-6);
    EXPECT_GE(view.height, 8);
    EXPECT_LE(view.height, 10);
  }
  const FirstView high = FirstViewOf(LineAndCircle({0, 1e3, 0}, {0, 0, 0}));
  EXPECT_GE(high.height, 1002);
  EXPECT_LE(high.height, 1250);
}

TEST(EncodeDxfDrawing, HasAViewAlsoWithoutCurvesOrOfALineUpwards) {
  EXPECT_GT(FirstViewOf({}).height, 0);
  CurveFit line;
  line.start = {50, 60, 0};
  line.end = {50, 60, 1};
  FittedCurves fitted;
  fitted.curves = {{{line}}};
  const FirstView view = FirstViewOf(fitted);
  EXPECT_EQ(view.center, Eigen::Vector2d(50, 60));
  EXPECT_GT(view.height, 0);
}

}  // namespace
}  // namespace curvix
