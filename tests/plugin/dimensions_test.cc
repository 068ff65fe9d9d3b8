// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/dimensions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/angles.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "measuring/moved_curves.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

constexpr double kSigma = 0.0005;

struct Row {
  std::string dimension, from, to, unit;
  double value = 0, sigma = 0;
};

std::vector<Row> Rows(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "dimension,from,to,value,sigma,unit");
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    Row row;
    std::string value, sigma;
    std::getline(fields, row.dimension, ',');
    std::getline(fields, row.from, ',');
    std::getline(fields, row.to, ',');
    std::getline(fields, value, ',');
    std::getline(fields, sigma, ',');
    std::getline(fields, row.unit, ',');
    row.value = std::stod(value);
    row.sigma = std::stod(sigma);
    rows.push_back(row);
  }
  return rows;
}

Curve Noisy(const std::vector<Vector3d>& points, bool closed, Random& random) {
  Curve curve;
  curve.closed = closed;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    CurveSample& s = curve.samples.emplace_back();
    const Vector3d& next = points[i + 1 < n ? i + 1 : (closed ? 0 : i)];
    const Vector3d& last = points[i > 0 ? i - 1 : (closed ? n - 1 : 0)];
    s.tangent = (next - last).normalized();
    s.position = points[i];
    const bool is_end = !closed && (i == 0 || i + 1 == n);
    if (!is_end) s.position += kSigma * random.Across(s.tangent);
    s.sigma = kSigma;
  }
  return curve;
}

// A rectangle, 2 by 1, with two holes of radius 0.2 and 0.1, 1 apart.
CurveSet Plate(std::uint64_t seed) {
  Random random(seed);
  CurveSet set;
  const Vector3d corners[] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  for (int side = 0; side < 4; ++side) {
    const Vector3d a = corners[side], b = corners[(side + 1) % 4];
    std::vector<Vector3d> points;
    for (int i = 0; i <= 80; ++i) points.push_back(a + (b - a) * i / 80.0);
    points.back() = b;
    set.curves.push_back(Noisy(points, false, random));
  }
  for (const auto& [x, radius] : {std::pair(0.5, 0.2), std::pair(1.5, 0.1)}) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 90; ++i) {
      const double t = 2 * kPi * i / 90;
      points.emplace_back(
          x + radius * std::cos(t), 0.5 + radius * std::sin(t), 0);
    }
    set.curves.push_back(Noisy(points, true, random));
  }
  return set;
}

std::string Csv(const CurveSet& set, const WorldAlignment* alignment) {
  const Scene scene;
  const CurvesInMemory curves(set);
  FittedCurves fitted = FitCurves(set, {}, {}, 1);
  if (alignment != nullptr) {
    fitted = MoveFits(alignment->world_from_model, std::move(fitted));
  }
  std::string csv;
  EncodeDimensions({scene, curves, fitted, alignment},
                   [&](std::string_view bytes) { csv += bytes; });
  return csv;
}

TEST(Dimensions, OfAPlateAreThoseThatItHas) {
  const std::map<std::string, std::vector<double>> truth = {
      {"length", {2, 2, 1, 1}}, {"radius", {0.2, 0.1}}};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    std::map<std::string, std::vector<Row>> rows;
    for (const Row& row : Rows(Csv(Plate(seed), nullptr))) {
      rows[row.dimension].push_back(row);
      EXPECT_GT(row.sigma, 0);
    }
    for (const auto& [dimension, values] : truth) {
      ASSERT_EQ(rows[dimension].size(), values.size()) << dimension;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const Row& row = rows[dimension][i];
        EXPECT_NEAR(row.value, values[i], 3 * row.sigma) << row.from;
        EXPECT_LT(row.sigma, 0.02 * values[i]) << row.from;
      }
    }
    // Six pairs of lines, two of which are parallel.
    ASSERT_EQ(rows["angle"].size(), 6u);
    for (const Row& row : rows["angle"]) {
      EXPECT_NEAR(row.value, row.value < 45 ? 0 : 90, 4 * row.sigma);
      EXPECT_EQ(row.unit, "deg");
    }
    bool has_width = false, has_centres = false;
    for (const Row& row : rows["distance"]) {
      const double nearest = std::min({std::abs(row.value - 1),
                                       std::abs(row.value - 2),
                                       std::abs(row.value - std::sqrt(5))});
      EXPECT_LT(nearest, 4 * row.sigma) << row.from << " " << row.to;
      has_width = has_width || (row.from.rfind("line", 0) == 0);
      has_centres = has_centres || (row.from.rfind("circle", 0) == 0);
    }
    EXPECT_TRUE(has_width && has_centres);
  }
}

TEST(Dimensions, ScaleMultipliesAllLengths) {
  WorldAlignment alignment;
  alignment.world_from_model.scale = 1000;
  alignment.unit = "mm";
  const auto one = Rows(Csv(Plate(1), nullptr));
  const auto two = Rows(Csv(Plate(1), &alignment));
  alignment.covariance(0, 0) = 0.01 * 0.01;
  const auto three = Rows(Csv(Plate(1), &alignment));
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double scale = one[i].dimension == "angle" ? 1 : 1000;
    EXPECT_EQ(one[i].from, two[i].from);
    EXPECT_NEAR(two[i].value, scale * one[i].value, 1e-6 * two[i].value);
    EXPECT_NEAR(two[i].sigma, scale * one[i].sigma, 1e-6 * two[i].sigma);
    EXPECT_EQ(two[i].unit, scale > 1 ? "mm" : "deg");
    const double of_scale = scale > 1 ? 0.01 * two[i].value : 0;
    EXPECT_NEAR(three[i].sigma,
                std::hypot(two[i].sigma, of_scale),
                1e-6 * three[i].sigma);
  }
}

TEST(Dimensions, NumberOfRowsIsBounded) {
  Random random(9);
  CurveSet set;
  for (int c = 0; c < 400; ++c) {
    const Vector3d from = random.NormalVector(), to = random.NormalVector();
    std::vector<Vector3d> points;
    for (int i = 0; i <= 20; ++i) points.push_back(from + (to - from) * i / 20);
    set.curves.push_back(Noisy(points, false, random));
  }
  const auto rows = Rows(Csv(set, nullptr));
  EXPECT_GT(rows.size(), 200u);
  EXPECT_LE(rows.size(), 100u + 100 + 4 * 105);
}

std::string CsvOf(const FittedCurves& fitted) {
  const Scene scene;
  const CurveSet set;
  const CurvesInMemory curves(set);
  std::string csv;
  EncodeDimensions({scene, curves, fitted},
                   [&](std::string_view bytes) { csv += bytes; });
  return csv;
}

CurveFit ArcOf(double radius, bool closed) {
  CurveFit fit;
  fit.kind = FitKind::kArc;
  fit.closed = closed;
  fit.major = {radius, 0, 0};
  fit.minor = {0, radius, 0};
  fit.end_angle = closed ? 2 * kPi : 0.1;
  return fit;
}

TEST(Dimensions, CirclesComeBeforeLargerArcs) {
  FittedCurves fitted;
  for (int i = 0; i < 120; ++i) {
    fitted.curves.push_back({{ArcOf(100 + i, false)}});
  }
  for (int i = 0; i < 3; ++i) fitted.curves.push_back({{ArcOf(1 + i, true)}});
  std::map<std::string, int> counts;
  for (const Row& row : Rows(CsvOf(fitted))) {
    ++counts[row.dimension + " " + row.from.substr(0, row.from.find(' '))];
  }
  EXPECT_EQ(counts["radius circle"], 3);
  EXPECT_EQ(counts["radius arc"], 97);
  EXPECT_EQ(counts["distance circle"], 3);
}

TEST(Dimensions, LinesOfNoLengthHaveNone) {
  FittedCurves fitted;
  CurveFit line;
  fitted.curves.push_back({{line}});
  line.end = {1, 0, 0};
  fitted.curves.push_back({{line}});
  const std::vector<Row> rows = Rows(CsvOf(fitted));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].from, "line 1.0");
}

TEST(Dimensions, OfNothingAreAHeader) {
  EXPECT_TRUE(Rows(Csv({}, nullptr)).empty());
}

}  // namespace
}  // namespace curvix
