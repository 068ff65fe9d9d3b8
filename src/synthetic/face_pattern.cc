// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/face_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "synthetic/counter_random.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNarrowest = 0.1;  // face with a pattern, units

void AppendLine(const Vector2d& from,
                const Vector2d& to,
                std::vector<TrueCurve>& lines) {
  lines.push_back(Segment(Vector3d(from.x(), from.y(), 0),
                          Vector3d(to.x(), to.y(), 0),
                          CurveKind::kMarking));
}

void AppendRectangle(const Vector2d& low,
                     const Vector2d& high,
                     std::vector<TrueCurve>& lines) {
  AppendLine(low, {high.x(), low.y()}, lines);
  AppendLine({high.x(), low.y()}, high, lines);
  AppendLine(high, {low.x(), high.y()}, lines);
  AppendLine({low.x(), high.y()}, low, lines);
}

// A running bond: every second course is shifted by half a brick.
class Bricks : public FacePattern {
 public:
  Bricks(const FaceArea& area, double unit, std::uint64_t seed)
      : area_(area), seed_(seed) {
    const Vector2d size = area.high - area.low;
    const auto count = [](double total, double each) {
      return std::max(1, static_cast<int>(std::lround(total / each)));
    };
    num_courses_ = count(size.y(), 0.065 * unit);
    num_bricks_ = count(size.x(), 0.15 * unit);
    course_ = size.y() / num_courses_;
    brick_ = size.x() / num_bricks_;
    half_joint_ = std::min(0.0055 * unit, course_ / 8);
  }

  Value At(const Vector2d& uv) const override {
    const double v = uv.y() - area_.low.y();
    const int course = std::clamp(
        static_cast<int>(std::floor(v / course_)), 0, num_courses_ - 1);
    const double u = uv.x() - area_.low.x() - Shift(course);
    auto k = static_cast<int>(std::floor(u / brick_));
    if (area_.is_round && k < 0) k += num_bricks_;
    const double turn = area_.is_round && u < 0 ? num_bricks_ * brick_ : 0;
    const auto [begin, end] = Brick(course, k);
    const double from_joint = std::min({u + turn + Shift(course) - begin,
                                        end - (u + turn + Shift(course)),
                                        v - course * course_,
                                        (course + 1) * course_ - v});
    if (from_joint < half_joint_) return {1, 1};
    const std::uint64_t id =
        Mix(seed_, static_cast<std::uint64_t>(course * 4096 + k + 1));
    return {0.48 + 0.2 * Uniform(id), id};
  }

  std::vector<TrueCurve> Outlines() const override {
    std::vector<TrueCurve> lines;
    const Vector2d half(half_joint_, half_joint_);
    for (int course = 0; course < num_courses_; ++course) {
      const int first = Shift(course) > 0 && !area_.is_round ? -1 : 0;
      for (int k = first; k < num_bricks_; ++k) {
        const auto [begin, end] = Brick(course, k);
        AppendRectangle(
            area_.low + Vector2d(begin, course * course_) + half,
            area_.low + Vector2d(end, (course + 1) * course_) - half,
            lines);
      }
    }
    return lines;
  }

 private:
  double Shift(int course) const { return course % 2 == 1 ? brick_ / 2 : 0; }

  // Begin and end of the k-th brick along u, from the low end of the face.
  std::pair<double, double> Brick(int course, int k) const {
    const double begin = Shift(course) + k * brick_;
    if (area_.is_round) return {begin, begin + brick_};
    return {std::max(0.0, begin),
            std::min(num_bricks_ * brick_, begin + brick_)};
  }

  FaceArea area_;
  std::uint64_t seed_;
  int num_courses_ = 0;
  int num_bricks_ = 0;
  double course_ = 0;  // height, joint included
  double brick_ = 0;   // length, likewise
  double half_joint_ = 0;
};

// Stripes along the longer side, all bent by the same wave of arcs.
class Grain : public FacePattern {
 public:
  Grain(const FaceArea& area, double unit, std::uint64_t seed)
      : area_(area), seed_(seed), chord_(0.3 * unit), bend_(0.008 * unit) {
    const Vector2d size = area.high - area.low;
    along_ = size.x() >= size.y() ? 0 : 1;
    const int across = 1 - along_;
    radius_ = (chord_ * chord_ / 4 + bend_ * bend_) / (2 * bend_);
    double at = area.low[across] - bend_;
    for (std::uint64_t i = 0; at < area.high[across] + bend_; ++i) {
      at += (0.03 + 0.05 * Uniform(Mix(seed, i))) * unit;
      borders_.push_back(at);
    }
  }

  Value At(const Vector2d& uv) const override {
    const double t = uv[along_] - area_.low[along_];
    const double s = uv[1 - along_] - Wave(t);
    const auto stripe = static_cast<std::uint64_t>(
        std::ranges::upper_bound(borders_, s) - borders_.begin());
    const double share = Uniform(Mix(seed_ + 1, stripe));
    return {stripe % 2 == 0 ? 0.85 + 0.15 * share : 0.5 + 0.15 * share,
            stripe + 1};
  }

  std::vector<TrueCurve> Outlines() const override {
    std::vector<TrueCurve> arcs;
    const double length = area_.high[along_] - area_.low[along_];
    const auto num_arcs = static_cast<int>(std::ceil(length / chord_));
    for (const double border : borders_) {
      for (int i = 0; i < num_arcs; ++i) arcs.push_back(Arc(i, border));
    }
    return arcs;
  }

 private:
  static double Side(int arc) { return arc % 2 == 0 ? 1 : -1; }

  double Wave(double t) const {
    const auto arc = static_cast<int>(std::floor(t / chord_));
    const double from_middle = t - (arc + 0.5) * chord_;
    return Side(arc) *
           (std::sqrt(radius_ * radius_ - from_middle * from_middle) -
            (radius_ - bend_));
  }

  TrueCurve Arc(int i, double border) const {
    const Vector3d ahead = Vector3d::Unit(along_);
    const Vector3d aside = Side(i) * Vector3d::Unit(1 - along_);
    const double half_angle = std::asin(chord_ / 2 / radius_);
    TrueCurve arc;
    arc.kind = CurveKind::kMarking;
    arc.origin = (area_.low[along_] + (i + 0.5) * chord_) * ahead +
                 border * Vector3d::Unit(1 - along_) -
                 (radius_ - bend_) * aside;
    arc.radius = radius_;
    arc.along = std::cos(half_angle) * aside - std::sin(half_angle) * ahead;
    arc.across = std::cos(half_angle) * ahead + std::sin(half_angle) * aside;
    arc.length = 2 * half_angle * radius_;
    return arc;
  }

  FaceArea area_;
  std::uint64_t seed_;
  double chord_;  // of the arcs
  double bend_;   // their height
  double radius_ = 0;
  int along_ = 0;
  std::vector<double> borders_;  // ascending
};

// A label with letters, and on flat faces a disc and a ring.
class Print : public FacePattern {
 public:
  explicit Print(const FaceArea& area) : is_round_(area.is_round) {
    const Vector2d size = area.high - area.low;
    const double width = (is_round_ ? 0.45 : 0.85) * size.x();
    cell_ = std::min(width / kColumns, 0.85 * size.y() / num_rows());
    const Vector2d label = cell_ * Vector2d(kColumns, num_rows());
    low_ = (area.low + area.high - label) / 2;
  }

  Value At(const Vector2d& uv) const override {
    const Vector2d at = (uv - low_) / cell_;  // from the label's lower left
    const double top = num_rows() - at.y();
    if (at.x() < 0 || at.x() >= kColumns || at.y() < 0 || top <= 0) {
      return {0.75, 1};
    }
    const bool is_ink =
        IsInk(static_cast<int>(top), static_cast<int>(at.x())) || InRounds(at);
    return is_ink ? Value{0.35, 2} : Value{1.05, 3};
  }

  std::vector<TrueCurve> Outlines() const override {
    std::vector<TrueCurve> lines;
    AppendRectangle(low_, low_ + cell_ * Vector2d(kColumns, num_rows()), lines);
    for (const bool is_level : {true, false}) {
      const int num_lines = is_level ? kTextRows : kColumns;
      const int num_cells = is_level ? kColumns : kTextRows;
      for (int line = 1; line < num_lines; ++line) {
        AppendSteps(is_level, line, num_cells, lines);
      }
    }
    if (is_round_) return lines;
    for (const auto& [centre, radius] : Rounds()) {
      const Vector2d at = low_ + cell_ * centre;
      lines.push_back(Circle({at.x(), at.y(), 0},
                             Vector3d::UnitZ(),
                             cell_ * radius,
                             CurveKind::kMarking));
    }
    return lines;
  }

 private:
  static constexpr int kColumns = 17;
  static constexpr int kTextRows = 13;
  static constexpr int kRoundRows = 8;
  static constexpr std::array<std::string_view, kTextRows> kText = {
      ".................",  //
      ".###.#.#.###.#...",  //
      "..#..#.#.#...#...",  //
      "..#..###.##..#...",  //
      "..#..#.#.#...#...",  //
      "..#..#.#.###.###.",  //
      ".................",  //
      ".#.#.###.#.#.###.",  //
      ".#.#..#..#.#.#...",  //
      ".###..#..###.##..",  //
      ".#.#..#..#.#.#...",  //
      ".#.#.###.#.#.#...",  //
      "................."};

  int num_rows() const { return kTextRows + (is_round_ ? 0 : kRoundRows); }

  static bool IsInk(int row, int column) {
    return row < kTextRows && kText[static_cast<std::size_t>(row)]
                                   [static_cast<std::size_t>(column)] == '#';
  }

  // Centres and radii: a disc, and a ring's outer and inner circle. Cells.
  static const std::array<std::pair<Vector2d, double>, 3>& Rounds() {
    static const std::array<std::pair<Vector2d, double>, 3> rounds = {
        std::pair(Vector2d(4.5, 4), 3.0),
        std::pair(Vector2d(12.5, 4), 3.0),
        std::pair(Vector2d(12.5, 4), 1.7)};
    return rounds;
  }

  bool InRounds(const Vector2d& at) const {
    if (is_round_) return false;
    const auto inside = [&](std::size_t i) {
      return (at - Rounds()[i].first).norm() < Rounds()[i].second;
    };
    return inside(0) || (inside(1) && !inside(2));
  }

  // The segments of one line of the grid across which the ink changes.
  void AppendSteps(bool is_level,
                   int line,
                   int num_cells,
                   std::vector<TrueCurve>& lines) const {
    const auto change = [&](int i) {
      if (i == num_cells) return 0;
      return is_level ? IsInk(line, i) - IsInk(line - 1, i)
                      : IsInk(i, line) - IsInk(i, line - 1);
    };
    const auto place = [&](int i) {
      const Vector2d from_top =
          is_level ? Vector2d(i, line) : Vector2d(line, i);
      return Vector2d(
          low_ + cell_ * Vector2d(from_top.x(), num_rows() - from_top.y()));
    };
    int begin = 0;
    for (int i = 1; i <= num_cells; ++i) {
      if (change(i) == change(i - 1)) continue;
      if (change(i - 1) != 0) AppendLine(place(begin), place(i), lines);
      begin = i;
    }
  }

  bool is_round_;
  double cell_ = 0;  // world units
  Vector2d low_;     // lower left corner of the label
};

}  // namespace

std::unique_ptr<FacePattern> MakeFacePattern(SurfacePattern pattern,
                                             const FaceArea& area,
                                             double unit,
                                             std::uint64_t seed) {
  if ((area.high - area.low).minCoeff() < kNarrowest * unit) return nullptr;
  switch (pattern) {
    case SurfacePattern::kBrick:
      return std::make_unique<Bricks>(area, unit, seed);
    case SurfacePattern::kWood:
      if (area.is_round) return nullptr;
      return std::make_unique<Grain>(area, unit, seed);
    case SurfacePattern::kPrint:
      return std::make_unique<Print>(area);
    default:
      return nullptr;
  }
}

}  // namespace curvix
