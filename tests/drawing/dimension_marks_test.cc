// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/dimension_marks.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "io/sheet_formats.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using testing::HasSubstr;

SheetDimension Dimension(const Vector2d& a, const Vector2d& b) {
  SheetDimension dimension;
  dimension.a = a;
  dimension.b = b;
  dimension.value = (b - a).norm();
  dimension.text = "100.0";
  return dimension;
}

Eigen::AlignedBox2d BoxFrom(const Vector2d& low, const Vector2d& high) {
  return {low, high};
}

// 2 mm on the paper for each unit.
Sheet MadeSheet() {
  Sheet sheet;
  sheet.scale = 2;
  sheet.size = {420, 297};
  return sheet;
}

TEST(PlaceDimensions, GoOutwardsAndBesideEachOther) {
  Sheet sheet = MadeSheet();
  PlaceDimensions({Dimension({0, 0}, {100, 0}),
                   Dimension({100, 0}, {20, 0}),  // at the same place
                   Dimension({0, 40}, {100, 40}),
                   Dimension({0, 0}, {1, 0})},  // too short for its text
                  BoxFrom({0, 0}, {100, 40}),
                  {},
                  sheet);
  ASSERT_EQ(sheet.dimensions.size(), 3u);
  std::vector<double> heights;  // of the dimension lines, mm
  for (const SheetDimension& dimension : sheet.dimensions) {
    const DimensionMarks marks = MarksOf(dimension, sheet);
    EXPECT_NEAR(marks.lines[0].start.y(), marks.lines[0].end.y(), 1e-9);
    EXPECT_NEAR(marks.angle, 0, 1e-9);
    heights.push_back(marks.lines[0].start.y());
  }
  EXPECT_NEAR(heights[0], -8, 1e-9);
  EXPECT_NEAR(heights[1], -14, 1e-9);
  EXPECT_NEAR(heights[2], 2 * 40 + 8, 1e-9);
}

TEST(PlaceDimensions, GoNowhereIntoOtherViews) {
  SheetDimension radius = Dimension({50, 10}, {50, 0});
  radius.is_radius = true;
  const std::vector<SheetDimension> dimensions = {
      Dimension({0, 0}, {100, 0}), Dimension({0, 40}, {100, 40}), radius};
  const auto view = BoxFrom({0, 0}, {100, 40});
  // Beneath it, 1.5 to 40 units off.
  for (const auto& [off, num_placed] :
       {std::pair(1.5, 1u), std::pair(5.0, 1u), std::pair(40.0, 3u)}) {
    const auto other = BoxFrom({0, -60 - off}, {100, -off});
    Sheet sheet = MadeSheet();
    PlaceDimensions(dimensions, view, {other}, sheet);
    EXPECT_EQ(sheet.dimensions.size(), num_placed) << off;
    for (const SheetDimension& dimension : sheet.dimensions) {
      for (const SheetLine& line : MarksOf(dimension, sheet).lines) {
        EXPECT_FALSE(other.contains(sheet.FromPaper(line.end)));
      }
    }
  }
}

TEST(MarksOf, UprightTextIsReadFromTheRight) {
  Sheet sheet = MadeSheet();
  PlaceDimensions({Dimension({0, 0}, {1e-4, -50}), Dimension({9, 0}, {9, 50})},
                  BoxFrom({0, 0}, {8, 0}),
                  {},
                  sheet);
  for (const SheetDimension& dimension : sheet.dimensions) {
    EXPECT_NEAR(MarksOf(dimension, sheet).angle, 1.5708, 1e-3);
  }
}

TEST(EncodeDxfSheet, DimensionsAreEntitiesWithBlocks) {
  Sheet sheet = MadeSheet();
  SheetDimension radius = Dimension({30, 30}, {60, 70});
  radius.is_radius = true;
  radius.text = "R50.0";
  PlaceDimensions({Dimension({0, 0}, {100, 0}), radius},
                  BoxFrom({0, 0}, {100, 40}),
                  {},
                  sheet);
  const std::string dxf = EncodeDxfSheet(sheet);
  EXPECT_THAT(dxf, HasSubstr("\n2\n*D2\n70\n1\n"));
  EXPECT_THAT(dxf, HasSubstr("$DIMTXT\n40\n1.25\n"));
  const std::string entities = dxf.substr(dxf.find("ENTITIES"));
  EXPECT_THAT(entities, HasSubstr("DIMENSION\n"));
  EXPECT_THAT(entities,
              HasSubstr("70\n33\n1\n100.0\n71\n5\n42\n100.0\n3\nStandard\n100\n"
                        "AcDbAlignedDimension\n13\n0.0\n23\n0.0\n33\n0.0\n"
                        "14\n100.0\n24\n0.0\n"));
  EXPECT_THAT(entities,
              HasSubstr("70\n36\n1\nR50.0\n71\n5\n42\n50.0\n3\nStandard\n100\n"
                        "AcDbRadialDimension\n15\n60.0\n25\n70.0\n"));
  const std::string svg = EncodeSvgSheet(sheet);
  EXPECT_THAT(svg, HasSubstr("<g id=\"DIMENSIONS\""));
  EXPECT_THAT(svg, HasSubstr(">R50.0</text>"));
}

}  // namespace
}  // namespace curvix
