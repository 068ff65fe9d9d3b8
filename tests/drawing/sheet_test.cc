// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/sheet.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/angles.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "io/sheet_formats.h"

namespace curvix {
namespace {

using testing::HasSubstr;

// A front of 10 by 4 m, with a marking on it and a round window.
std::vector<SheetCurve> Front() {
  CurveFit outline;
  outline.curve_kind = CurveKind::kBoundary;
  outline.start = {100, 7, 0};
  outline.end = {110, 11, 0};
  CurveFit marking = outline;
  marking.curve_kind = CurveKind::kMarking;
  marking.end = {103, 11, 0};
  CurveFit window;
  window.kind = FitKind::kArc;
  window.closed = true;
  window.curve_kind = CurveKind::kCrease;
  window.center = {105, 9, 0};
  window.major = {0.5, 0, 0};
  window.minor = {0, 0.5, 0};
  window.end_angle = 2 * kPi;
  return {{outline}, {marking, true}, {window}};
}

SheetSettings InMetres() {
  SheetSettings settings;
  settings.title = "Rathaus M\xc3\xbcnster <front>";
  settings.unit = "m";
  settings.millimetres = 1000;
  settings.paper = "a4";
  return settings;
}

TEST(ParseScale, TakesRatiosAndNumbers) {
  EXPECT_EQ(ParseScale("1:50"), 50);
  EXPECT_EQ(ParseScale("50"), 50);
  EXPECT_EQ(ParseScale("2:1"), 0.5);
  for (const char* text : {"", "x", "1:", ":50", "0:5", "1:0", "-1", "1:inf"}) {
    EXPECT_FALSE(ParseScale(text).has_value()) << text;
  }
}

TEST(Sheet, TheLargestRoundScaleThatFitsIsChosen) {
  const auto sheet = LaySheet(InMetres(), Front(), std::nullopt);
  ASSERT_TRUE(sheet.ok()) << sheet.status().message();
  EXPECT_EQ(sheet->scale_text, "1:50 on A4");
  EXPECT_EQ(sheet->scale, 20);  // mm per m
  const Eigen::Vector2d low = sheet->ToPaper({100, 7});
  const Eigen::Vector2d high = sheet->ToPaper({110, 11});
  EXPECT_NEAR((high - low).x(), 200, 1e-9);
  EXPECT_GT(low.minCoeff(), 10);
  EXPECT_LT(high.x(), 287);
  EXPECT_LT(high.y(), 200);
  EXPECT_LT((sheet->FromPaper(low) - Eigen::Vector2d(100, 7)).norm(), 1e-9);
}

TEST(Sheet, ScalesHaveNoExponents) {
  SheetSettings settings = InMetres();
  settings.denominator = 1000000;
  const auto sheet = LaySheet(settings, Front(), std::nullopt);
  ASSERT_TRUE(sheet.ok()) << sheet.status().message();
  EXPECT_EQ(sheet->scale_text, "1:1000000 on A4");
}

TEST(Sheet, SaysWhatCannotBe) {
  SheetSettings settings = InMetres();
  settings.denominator = 10;
  EXPECT_THAT(LaySheet(settings, Front(), std::nullopt).status().message(),
              HasSubstr("At 1:10 the drawing takes 1036 x 454 mm, more than "
                        "A4 has"));
  settings.millimetres = 0;
  EXPECT_THAT(LaySheet(settings, Front(), std::nullopt).status().message(),
              HasSubstr("colmap_curvix align"));
  EXPECT_FALSE(LaySheet(InMetres(), {}, std::nullopt).ok());
  settings.denominator = 0;
  settings.unit = "";
  const auto sheet = LaySheet(settings, Front(), std::nullopt);
  ASSERT_TRUE(sheet.ok());
  EXPECT_EQ(sheet->scale_text, "no scale; 1 unit is 20 mm");
}

// The values of group codes, entity by entity.
using Entity = std::multimap<int, std::string>;

std::vector<Entity> Entities(const std::string& dxf) {
  std::istringstream lines(dxf.substr(dxf.find("ENTITIES")));
  std::string code, value;
  std::getline(lines, value);
  std::vector<Entity> entities;
  while (std::getline(lines, code) && std::getline(lines, value)) {
    if (value == "ENDSEC") break;
    if (code == "0") entities.emplace_back();
    entities.back().emplace(std::stoi(code), value);
  }
  return entities;
}

std::string Value(const Entity& entity, int code) {
  const auto found = entity.find(code);
  return found == entity.end() ? "" : found->second;
}

TEST(Sheet, DxfIsInDrawingUnits) {
  auto sheet = LaySheet(InMetres(), Front(), std::nullopt);
  ASSERT_TRUE(sheet.ok());
  sheet->picture = SheetPicture{"front.jpg", {400, 200}, {100, 7}, 0.025};
  const std::string dxf = EncodeDxfSheet(*sheet);
  EXPECT_THAT(dxf, HasSubstr("$INSUNITS\n70\n6\n"));
  EXPECT_THAT(dxf, HasSubstr("Rathaus M\\U+00FCnster"));
  const std::vector<Entity> entities = Entities(dxf);
  std::map<std::string, std::vector<std::string>> layers;
  for (const Entity& entity : entities) {
    layers[Value(entity, 8)].push_back(Value(entity, 0));
    if (Value(entity, 8) == "BOUNDARIES") {
      EXPECT_EQ(std::stod(Value(entity, 10)), 100);
      EXPECT_EQ(std::stod(Value(entity, 21)), 11);
    }
    EXPECT_EQ(Value(entity, 6), Value(entity, 8) == "MARKINGS" ? "HIDDEN" : "");
    if (Value(entity, 0) == "CIRCLE") {
      EXPECT_EQ(std::stod(Value(entity, 40)), 0.5);
    }
  }
  EXPECT_EQ(layers["BOUNDARIES"], std::vector<std::string>{"LINE"});
  EXPECT_EQ(layers["MARKINGS"], std::vector<std::string>{"LINE"});
  EXPECT_EQ(layers["CREASES"], std::vector<std::string>{"CIRCLE"});
  EXPECT_EQ(layers["PHOTOGRAPH"], std::vector<std::string>{"IMAGE"});
  EXPECT_GT(layers["FRAME"].size(), 8u);
}

// Escapes of DXF have four digits.
TEST(Sheet, DxfHasRareCharactersAsTwoUnitsOfUtf16) {
  SheetSettings settings = InMetres();
  settings.title = "\xf0\x9f\x98\x80 \xe2\x82\xac";
  const auto sheet = LaySheet(settings, Front(), std::nullopt);
  ASSERT_TRUE(sheet.ok()) << sheet.status().message();
  EXPECT_THAT(EncodeDxfSheet(*sheet), HasSubstr("\\U+D83D\\U+DE00 \\U+20AC"));
}

// "^A" and "%%c" would be a control character and a sign of diameter.
TEST(Sheet, DxfHasTextsAsTheyAre) {
  SheetSettings settings = InMetres();
  settings.title = "^A 50% %%c %%%\t.";
  const auto sheet = LaySheet(settings, Front(), std::nullopt);
  ASSERT_TRUE(sheet.ok()) << sheet.status().message();
  EXPECT_THAT(EncodeDxfSheet(*sheet),
              HasSubstr("\n^ A 50% %\\U+0025c %\\U+0025\\U+0025 .\n"));
}

TEST(Sheet, SvgHasNoControlCharacters) {
  SheetSettings settings = InMetres();
  settings.title = "a";
  for (char c = 1; c < 0x20; ++c) settings.title += c;
  settings.title += "b";
  auto sheet = LaySheet(settings, Front(), std::nullopt);
  ASSERT_TRUE(sheet.ok()) << sheet.status().message();
  sheet->picture = SheetPicture{"a\x01\n.jpg", {4, 2}, {0, 0}, 1};
  const std::string svg = EncodeSvgSheet(*sheet);
  for (const char c : svg) EXPECT_TRUE(c == '\n' || c < 0 || c >= 0x20);
  EXPECT_THAT(svg, HasSubstr(">a" + std::string(31, ' ') + "b</text>"));
  EXPECT_THAT(svg, HasSubstr("href=\"a%01%0A.jpg\""));
}

TEST(Sheet, SvgNamesItsPictureByAUrl) {
  auto sheet = LaySheet(InMetres(), Front(), std::nullopt);
  ASSERT_TRUE(sheet.ok());
  sheet->picture = SheetPicture{"a#1&50%\xc3\xa4.jpg", {4, 2}, {0, 0}, 1};
  EXPECT_THAT(EncodeSvgSheet(*sheet),
              HasSubstr("href=\"a%231&amp;50%25%C3%A4.jpg\""));
}

TEST(Sheet, SvgIsInMillimetresOnPaper) {
  const auto sheet = LaySheet(InMetres(), Front(), std::nullopt);
  ASSERT_TRUE(sheet.ok());
  const std::string svg = EncodeSvgSheet(*sheet);
  EXPECT_THAT(svg, HasSubstr("width=\"297.0000mm\" height=\"210.0000mm\""));
  EXPECT_THAT(svg, HasSubstr("Rathaus M\xc3\xbcnster &lt;front>"));
  // 0.5 m at 1:50.
  EXPECT_THAT(svg, HasSubstr("A10.0000 10.0000"));
  const std::size_t dashes = svg.find("stroke-dasharray");
  EXPECT_GT(dashes, svg.find("id=\"MARKINGS\""));
  EXPECT_EQ(svg.find("stroke-dasharray", dashes + 1), std::string::npos);
  const std::size_t at = svg.find("d=\"M", svg.find("id=\"BOUNDARIES\""));
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  ASSERT_EQ(
      std::sscanf(svg.c_str() + at, "d=\"M%lf %lfL%lf %lf", &x0, &y0, &x1, &y1),
      4);
  EXPECT_NEAR(x1 - x0, 200, 1e-3);
  EXPECT_NEAR(y0 - y1, 80, 1e-3);
}

}  // namespace
}  // namespace curvix
