// SPDX-License-Identifier: BSD-3-Clause
#include "io/curve_formats.h"

#include <curvix/curve_io.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "base/angles.h"
#include "base/text_fields.h"
#include "tests/io/test_curves.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;

struct Entity {
  std::string type;                    // "" if it has several
  std::vector<std::string> arguments;  // without blanks
};
using Entities = std::map<std::string, Entity>;  // by "#<number>"

// "a,(b,c)" as "a" and "(b,c)".
std::vector<std::string> SplitArguments(const std::string& text) {
  std::vector<std::string> arguments(1);
  int depth = 0;
  bool quoted = false;
  for (const char c : text) {
    if (c == '\'') quoted = !quoted;
    if (!quoted) depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0 && !quoted) {
      arguments.emplace_back();
    } else {
      arguments.back() += c;
    }
  }
  EXPECT_EQ(depth, 0) << text;
  EXPECT_FALSE(quoted) << text;
  return arguments;
}

// The items of "(a,b)".
std::vector<std::string> Items(const std::string& list) {
  EXPECT_EQ(list.front(), '(');
  EXPECT_EQ(list.back(), ')');
  return SplitArguments(list.substr(1, list.size() - 2));
}

std::string Unquoted(const std::string& text) {
  return text.substr(1, text.size() - 2);
}

// Reads the data section by the grammar of ISO 10303-21. Each entity that is
// named must be there.
Entities Parse(std::string text) {
  const std::string begin = "ENDSEC;\nDATA;\n";
  const std::string end = "ENDSEC;\nEND-ISO-10303-21;\n";
  EXPECT_EQ(text.rfind("ISO-10303-21;\nHEADER;\n", 0), 0u);
  EXPECT_EQ(text.find(end), text.size() - end.size());
  const std::size_t from = text.find(begin) + begin.size();
  text = text.substr(from, text.size() - end.size() - from);
  text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
  static const std::regex instance(R"((#\d+)=([A-Z0-9_]*)\((.*)\))");
  Entities entities;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t stop = text.find(';', at);
    const std::string line = text.substr(at, stop - at);
    at = stop + 1;
    std::smatch match;
    EXPECT_TRUE(std::regex_match(line, match, instance)) << line;
    const Entity entity{match[2], SplitArguments(match[3])};
    EXPECT_TRUE(entities.emplace(match[1], entity).second) << line;
  }
  static const std::regex reference(R"(#\d+)");
  for (std::sregex_iterator i(text.begin(), text.end(), reference), none;
       i != none;
       ++i) {
    EXPECT_EQ(entities.count(i->str()), 1u) << i->str();
  }
  return entities;
}

double Number(const std::string& text) {
  static const std::regex real(R"([+-]?\d+\.\d*(E[+-]?\d+)?)");
  EXPECT_TRUE(std::regex_match(text, real)) << text;
  return ParseNumber<double>(text).value_or(NAN);
}

Eigen::Vector3d Vector(const Entities& entities, const std::string& name) {
  const std::vector<std::string> numbers =
      Items(entities.at(name).arguments.at(1));
  EXPECT_EQ(numbers.size(), 3u);
  return {Number(numbers[0]), Number(numbers[1]), Number(numbers[2])};
}

// The point of a LINE, CIRCLE or ELLIPSE at a parameter, as ISO 10303-42
// defines it.
Eigen::Vector3d PointOf(const Entities& entities,
                        const Entity& curve,
                        double parameter) {
  if (curve.type == "LINE") {
    const Entity& vector = entities.at(curve.arguments[2]);
    return Vector(entities, curve.arguments[1]) +
           parameter * Number(vector.arguments[2]) *
               Vector(entities, vector.arguments[1]);
  }
  const Entity& frame = entities.at(curve.arguments[1]);
  const Eigen::Vector3d normal = Vector(entities, frame.arguments[2]);
  const Eigen::Vector3d x = Vector(entities, frame.arguments[3]);
  EXPECT_NEAR(normal.dot(x), 0, 1e-12);
  const double second_size = Number(curve.arguments.back());
  return Vector(entities, frame.arguments[1]) +
         Number(curve.arguments[2]) * std::cos(parameter) * x +
         second_size * std::sin(parameter) * normal.cross(x);
}

// The curve that is trimmed, its points at both parameters and half-way. These
// must be those that the file gives beside the parameters.
std::vector<Eigen::Vector3d> TrimmedPoints(const Entities& entities,
                                           const Entity& trimmed) {
  EXPECT_EQ(trimmed.type, "TRIMMED_CURVE");
  const Entity& basis = entities.at(trimmed.arguments[1]);
  std::vector<double> at;
  for (const std::size_t i : {2u, 3u}) {
    const std::vector<std::string> trim = Items(trimmed.arguments[i]);
    const std::string prefix = "PARAMETER_VALUE(";
    EXPECT_EQ(trim.at(1).rfind(prefix, 0), 0u);
    at.push_back(Number(
        trim[1].substr(prefix.size(), trim[1].size() - prefix.size() - 1)));
    EXPECT_LT((PointOf(entities, basis, at.back()) - Vector(entities, trim[0]))
                  .norm(),
              1e-9);
  }
  if (basis.type != "LINE") {
    EXPECT_GE(std::min(at[0], at[1]), 0);
    EXPECT_LE(std::max(at[0], at[1]), 2 * kPi);
    if (at[1] < at[0]) at[1] += 2 * kPi;
  }
  EXPECT_LT(at[0], at[1]);
  return {PointOf(entities, basis, at[0]),
          PointOf(entities, basis, (at[0] + at[1]) / 2),
          PointOf(entities, basis, at[1])};
}

CurveFit Line() {
  CurveFit fit;
  fit.start = {1, 2e-7, -3};
  fit.end = {1.5, 123456.75, 1.0 / 3};
  return fit;
}

// About a tilted axis.
CurveFit Conic(FitKind kind, double start_angle, double end_angle) {
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(0.3, -0.5, 0.2, 0.7).normalized();
  CurveFit fit;
  fit.kind = kind;
  fit.closed = end_angle - start_angle > 6.28;
  fit.center = {10, -20, 3e5};
  fit.major = turn * Eigen::Vector3d(2.5, 0, 0);
  fit.minor = turn * Eigen::Vector3d(0, kind == FitKind::kArc ? 2.5 : 0.125, 0);
  fit.start_angle = start_angle;
  fit.end_angle = end_angle;
  fit.start = PointAt(fit, 0);
  fit.end = PointAt(fit, 1);
  return fit;
}

CurveFit Spline() {
  CurveFit fit;
  fit.kind = FitKind::kSpline;
  fit.knots = {0, 0, 0, 0, 0.25, 0.5, 1, 1, 1, 1};
  for (int i = 0; i < 6; ++i) {
    fit.control_points.emplace_back(i, i * i, 0.1 * i);
  }
  fit.start = fit.control_points.front();
  fit.end = fit.control_points.back();
  return fit;
}

FittedCurves Drawing(const std::vector<CurveFit>& fits) {
  FittedCurves drawing;
  for (const CurveFit& fit : fits) drawing.curves.push_back({{fit}});
  return drawing;
}

Entities Written(const FittedCurves& drawing) {
  return Parse(Encoded(EncodeStepDrawing, drawing));
}

// The curves of the only set of this name.
std::vector<Entity> CurvesOf(const Entities& entities,
                             const std::string& layer) {
  std::vector<Entity> curves;
  for (const auto& [name, entity] : entities) {
    if (entity.type != "GEOMETRIC_CURVE_SET") continue;
    if (Unquoted(entity.arguments[0]) != layer) continue;
    EXPECT_TRUE(curves.empty());
    for (const std::string& item : Items(entity.arguments[1])) {
      curves.push_back(entities.at(item));
    }
  }
  return curves;
}

void ExpectTrimmed(const CurveFit& fit, const std::string& layer) {
  const Entities entities = Written(Drawing({fit}));
  const std::vector<Entity> curves = CurvesOf(entities, layer);
  ASSERT_EQ(curves.size(), 1u);
  const auto points = TrimmedPoints(entities, curves[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((points[i] - PointAt(fit, 0.5 * static_cast<double>(i))).norm(),
              1e-9);
  }
}

TEST(StepDrawing, LinesReadBack) { ExpectTrimmed(Line(), "LINES"); }

TEST(StepDrawing, ArcsReadBackWhereverTheyStart) {
  for (const double start : {-3.1, -1.0, 0.0, 0.5, 3.1, kPi}) {
    for (const double sweep : {0.01, 1.0, kPi, 6.2}) {
      ExpectTrimmed(Conic(FitKind::kArc, start, start + sweep), "ARCS");
    }
  }
}

TEST(StepDrawing, PartsOfEllipsesReadBack) {
  ExpectTrimmed(Conic(FitKind::kEllipse, -2, 1), "ELLIPSES");
  ExpectTrimmed(Conic(FitKind::kEllipse, 3, 7), "ELLIPSES");
}

TEST(StepDrawing, WholeOnesAreNotTrimmed) {
  const CurveFit circle = Conic(FitKind::kArc, 0.5, 0.5 + 2 * kPi);
  const CurveFit ellipse = Conic(FitKind::kEllipse, 0.5, 0.5 + 2 * kPi);
  const Entities entities = Written(Drawing({circle, ellipse}));
  const std::vector<Entity> circles = CurvesOf(entities, "CIRCLES");
  ASSERT_EQ(circles.size(), 1u);
  EXPECT_EQ(circles[0].type, "CIRCLE");
  EXPECT_LT(
      (PointOf(entities, circles[0], 1.25) - PointAt(circle, 0.75 / (2 * kPi)))
          .norm(),
      1e-9);
  const std::vector<Entity> ellipses = CurvesOf(entities, "ELLIPSES");
  ASSERT_EQ(ellipses.size(), 1u);
  EXPECT_EQ(ellipses[0].type, "ELLIPSE");
  EXPECT_LT((PointOf(entities, ellipses[0], 1.25) -
             PointAt(ellipse, 0.75 / (2 * kPi)))
                .norm(),
            1e-9);
}

TEST(StepDrawing, SplinesReadBack) {
  const CurveFit fit = Spline();
  const Entities entities = Written(Drawing({fit}));
  const std::vector<Entity> curves = CurvesOf(entities, "SPLINES");
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].type, "B_SPLINE_CURVE_WITH_KNOTS");
  const std::vector<std::string>& arguments = curves[0].arguments;
  EXPECT_EQ(arguments[1], "3");
  const std::vector<std::string> points = Items(arguments[2]);
  ASSERT_EQ(points.size(), fit.control_points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(Vector(entities, points[i]), fit.control_points[i]);
  }
  EXPECT_EQ(arguments[4], ".F.");
  EXPECT_EQ(arguments[6], "(4,1,1,4)");
  EXPECT_EQ(arguments[7], "(0.,0.25,0.5,1.)");
}

TEST(StepDrawing, CurvesHaveTheirIdsAndLayers) {
  FittedCurves drawing = Drawing({Line(), Spline()});
  drawing.curves[1].fits.push_back(Line());
  const Entities entities = Written(drawing);
  const std::vector<Entity> lines = CurvesOf(entities, "LINES");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].arguments[0], "'curve_0'");
  EXPECT_EQ(lines[1].arguments[0], "'curve_1'");
  for (const auto& [name, entity] : entities) {
    if (entity.type != "PRESENTATION_LAYER_ASSIGNMENT") continue;
    const std::string item = Items(entity.arguments[2]).at(0);
    EXPECT_EQ(entities.at(item).type, "GEOMETRIC_CURVE_SET");
    EXPECT_EQ(entities.at(item).arguments[0], entity.arguments[0]);
  }
}

TEST(StepDrawing, UnitIsAMillimetre) {
  EXPECT_THAT(Encoded(EncodeStepDrawing, Drawing({Line()})),
              HasSubstr("LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.)"));
}

TEST(StepDrawing, WithoutCurvesThereIsNoWireframe) {
  const std::string text = Encoded(EncodeStepDrawing, FittedCurves());
  EXPECT_FALSE(Parse(text).empty());
  EXPECT_EQ(text.find("WIREFRAME"), std::string::npos);
}

TEST(StepDrawing, LinesOfNoLengthAreLeftOut) {
  CurveFit point = Line();
  point.end = point.start;
  const Entities entities = Written(Drawing({point, Line()}));
  EXPECT_EQ(CurvesOf(entities, "LINES").size(), 1u);
  for (const auto& [name, entity] : entities) {
    if (entity.type != "DIRECTION") continue;
    EXPECT_NEAR(Vector(entities, name).norm(), 1, 1e-9);
  }
}

TEST(StepDrawing, ExtensionChoosesTheFormat) {
  const TemporaryFolder folder;
  const FittedCurves drawing = Drawing({Line(), Spline()});
  ASSERT_TRUE(WriteDrawing(folder.path() / "a.step", drawing).ok());
  EXPECT_EQ(*ReadFile(folder.path() / "a.step"),
            Encoded(EncodeStepDrawing, drawing));
  EXPECT_EQ(WriteDrawing(folder.path() / "a.iges", drawing).code(),
            StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace curvix
