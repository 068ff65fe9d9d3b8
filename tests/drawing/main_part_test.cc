// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/sheet.h"

#include <gtest/gtest.h>
#include <vector>

namespace curvix {
namespace {

SheetCurve LineTo(double x0, double y0, double x1, double y1) {
  CurveFit line;
  line.start = {x0, y0, 0};
  line.end = {x1, y1, 0};
  return {line};
}

// A front of 10 by 6 with four windows.
std::vector<SheetCurve> House() {
  std::vector<SheetCurve> curves = {LineTo(0, 0, 10, 0),
                                    LineTo(0, 6, 10, 6),
                                    LineTo(0, 0, 0, 6),
                                    LineTo(10, 0, 10, 6)};
  for (const double x : {2.0, 7.0}) {
    for (const double y : {1.0, 4.0}) {
      curves.push_back(LineTo(x, y, x + 1, y));
      curves.push_back(LineTo(x, y, x, y + 1));
    }
  }
  return curves;
}

bool IsAllOf(const std::vector<SheetCurve>& curves) {
  return MainBoundsOf(curves).isApprox(BoundsOf(curves));
}

TEST(MainPart, IsAllOfACompactDrawing) {
  EXPECT_TRUE(IsAllOf(House()));
  EXPECT_TRUE(IsAllOf({LineTo(0, 0, 3, 1)}));
  EXPECT_TRUE(MainBoundsOf({}).isEmpty());
  // Beside a pole.
  EXPECT_TRUE(IsAllOf({LineTo(0, 0, 0, 20), LineTo(2, 4, 3, 4)}));
}

TEST(MainPart, DoesNotDependOnWhereMostOfTheLengthIs) {
  // Letters in one corner of a plate.
  std::vector<SheetCurve> curves = {LineTo(0, 0, 100, 0),
                                    LineTo(0, 60, 100, 60),
                                    LineTo(0, 0, 0, 60),
                                    LineTo(100, 0, 100, 60)};
  for (int i = 0; i < 2000; ++i) curves.push_back(LineTo(1, 1, 2, 3));
  EXPECT_TRUE(IsAllOf(curves));
}

TEST(MainPart, IsWithoutALineFarAway) {
  for (const SheetCurve& far : {LineTo(60, 2, 62, 3),
                                LineTo(-30, 2, -29, 2),
                                LineTo(4, 20, 5, 22),
                                LineTo(4, -9, 6, -9)}) {
    std::vector<SheetCurve> curves = House();
    curves.push_back(far);
    EXPECT_TRUE(MainBoundsOf(curves).isApprox(BoundsOf(House())));
  }
}

TEST(MainPart, IsBothOfTwoHouses) {
  std::vector<SheetCurve> curves = House();
  for (SheetCurve curve : House()) {
    curve.fit.start.x() += 40;
    curve.fit.end.x() += 40;
    curves.push_back(curve);
  }
  EXPECT_TRUE(IsAllOf(curves));
  // One of which is small, but more than a tenth.
  curves = House();
  curves.push_back(LineTo(40, 0, 46, 0));
  EXPECT_TRUE(IsAllOf(curves));
}

}  // namespace
}  // namespace curvix
