// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/dimension_marks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/angles.h"

namespace curvix {
namespace {

// mm on the paper.
constexpr double kFirstShift = 8;  // of a dimension line from its line
constexpr double kStep = 6;        // between dimension lines
constexpr int kMostSteps = 3;
constexpr double kBeyond = 1.5;  // ends of lines beyond where they lead
constexpr double kLeader = 8;
constexpr double kLeastLength = 8;
constexpr double kLeastRadius = 1.5;

Eigen::Vector2d Left(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

DimensionMarks MarksOfRadius(const Eigen::Vector2d& center,
                             const Eigen::Vector2d& at,
                             const std::string& text) {
  const Eigen::Vector2d out = (at - center).normalized();
  const Eigen::Vector2d end = at + kLeader * out;
  const double half = kDimensionText * static_cast<double>(text.size()) / 2;
  const double side = out.x() < 0 ? -1 : 1;
  const Eigen::Vector2d arrow = 0.3 * kBeyond * Left(out);
  const Eigen::Vector2d back = at + kBeyond * out;
  return {{{at, end}, {at, back + arrow}, {at, back - arrow}},
          {end + Eigen::Vector2d(side * (half + 1), -kDimensionText / 2),
           kDimensionText,
           text},
          0};
}

bool AreInOnePlace(const SheetDimension& a,
                   const SheetDimension& b,
                   const Sheet& sheet) {
  const Eigen::Vector2d along = (a.b - a.a).normalized();
  const Eigen::Vector2d other = (b.b - b.a).normalized();
  if (a.is_radius || b.is_radius ||
      std::abs(along.dot(Left(other))) > std::sin(DegToRad(5))) {
    return false;
  }
  const auto height = [&](const SheetDimension& d, const Eigen::Vector2d& u) {
    return sheet.scale * Left(along).dot(d.a) + d.shift * along.dot(u);
  };
  const auto range = [&](const SheetDimension& d) {
    return std::minmax({along.dot(d.a), along.dot(d.b)});
  };
  const auto [a_low, a_high] = range(a);
  const auto [b_low, b_high] = range(b);
  return std::abs(height(a, along) - height(b, other)) < kStep - 1e-6 &&
         a_low < b_high && b_low < a_high;
}

// What holds its line and its text, drawing units.
Eigen::AlignedBox2d PlaceOf(const SheetDimension& dimension,
                            const Sheet& sheet) {
  const DimensionMarks marks = MarksOf(dimension, sheet);
  Eigen::AlignedBox2d place;
  for (const Eigen::Vector2d& mm :
       {marks.lines[0].start, marks.lines[0].end, marks.text.start}) {
    const Eigen::Vector2d beyond = Eigen::Vector2d::Constant(kDimensionText);
    place.extend(sheet.FromPaper(mm - beyond));
    place.extend(sheet.FromPaper(mm + beyond));
  }
  return place;
}

}  // namespace

DimensionMarks MarksOf(const SheetDimension& dimension, const Sheet& sheet) {
  const Eigen::Vector2d a = sheet.ToPaper(dimension.a);
  const Eigen::Vector2d b = sheet.ToPaper(dimension.b);
  if (dimension.is_radius) return MarksOfRadius(a, b, dimension.text);
  const Eigen::Vector2d along = (b - a).normalized();
  const Eigen::Vector2d off = dimension.shift * Left(along);
  const Eigen::Vector2d beyond = kBeyond * off.normalized();
  const Eigen::Vector2d tick = kBeyond * (along + Left(along)) / 2;
  DimensionMarks marks;
  marks.lines = {{a + off, b + off},
                 {a + beyond, a + off + beyond},
                 {b + beyond, b + off + beyond},
                 {a + off - tick, a + off + tick},
                 {b + off - tick, b + off + tick}};
  // Read from below or from the right.
  const double upright = std::sin(DegToRad(1));
  const bool turned =
      along.x() < -upright || (along.x() < upright && along.y() < 0);
  const Eigen::Vector2d reading = turned ? Eigen::Vector2d(-along) : along;
  marks.angle = std::atan2(reading.y(), reading.x());
  marks.text = {
      (a + b) / 2 + off + Left(reading), kDimensionText, dimension.text};
  return marks;
}

void PlaceDimensions(std::vector<SheetDimension> dimensions,
                     const Eigen::AlignedBox2d& view,
                     const std::vector<Eigen::AlignedBox2d>& other_views,
                     Sheet& sheet) {
  for (SheetDimension& d : dimensions) {
    const double length = sheet.scale * (d.b - d.a).norm();
    if (length < (d.is_radius ? kLeastRadius : kLeastLength)) continue;
    const bool is_out =
        Left(d.b - d.a).dot((d.a + d.b) / 2 - view.center()) >= 0;
    const auto is_taken = [&](const SheetDimension& other) {
      return AreInOnePlace(d, other, sheet);
    };
    for (int step = 0; step <= kMostSteps; ++step) {
      d.shift = (is_out ? 1 : -1) * (kFirstShift + step * kStep);
      const Eigen::AlignedBox2d place = PlaceOf(d, sheet);
      if (std::ranges::none_of(sheet.dimensions, is_taken) &&
          std::ranges::none_of(other_views, [&](const auto& other) {
            return other.intersects(place);
          })) {
        sheet.dimensions.push_back(std::move(d));
        break;
      }
    }
  }
}

}  // namespace curvix
