// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/text_fields.h"

namespace curvix {
namespace {

// mm on the paper.
constexpr double kMargin = 10;  // around the frame
constexpr double kGap = 8;      // between frame and drawing
constexpr double kDimensionRoom = 16;
constexpr double kTitleHeight = 18;  // of the strip at the bottom
constexpr double kScaleWidth = 80;   // of the scale's part of it
constexpr double kLongestBar = 60;
constexpr double kTickHeight = 1.5;
constexpr double kLargeText = 5;
constexpr double kSmallText = 2.5;

// The largest of 1, 2 and 5 times a power of ten that is not above `limit`.
double RoundDown(double limit) {
  const double power = std::pow(10, std::floor(std::log10(limit)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= limit * (1 + 1e-9)) return digit * power;
  }
  return power;
}

Eigen::Vector2d PaperSize(const std::string& name) {
  constexpr std::array<std::array<double, 2>, 5> kSizes = {
      {{1189, 841}, {841, 594}, {594, 420}, {420, 297}, {297, 210}}};
  const auto& size = kSizes.at(static_cast<std::size_t>(name.back() - '0'));
  return {size[0], size[1]};
}

std::string Short(double value) {
  return value < 1e5 ? ShortText(value, 6) : FixedText(value, 0);
}

std::string ScaleText(double denominator) {
  return denominator >= 1 ? "1:" + Short(denominator)
                          : Short(1 / denominator) + ":1";
}

void AddBox(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Sheet& s) {
  const Eigen::Vector2d right(high.x(), low.y()), left(low.x(), high.y());
  for (const SheetLine& line :
       {SheetLine{low, right}, {right, high}, {high, left}, {left, low}}) {
    s.lines.push_back(line);
  }
}

// A bar of a round length, with its half, and its figures.
void AddScaleBar(const Eigen::Vector2d& at, Sheet& s) {
  const double length = RoundDown(kLongestBar / s.scale);
  const double mm = length * s.scale;
  s.lines.push_back({at, at + Eigen::Vector2d(mm, 0)});
  for (const double share : {0.0, 0.5, 1.0}) {
    const Eigen::Vector2d foot = at + Eigen::Vector2d(share * mm, 0);
    s.lines.push_back({foot, foot + Eigen::Vector2d(0, kTickHeight)});
    const std::string unit = s.unit.empty() ? "units" : s.unit;
    s.texts.push_back({foot + Eigen::Vector2d(0, kTickHeight + 1),
                       kSmallText,
                       Short(share * length) + (share == 1 ? " " + unit : "")});
  }
}

void AddTitle(const SheetSettings& settings, Sheet& s) {
  const Eigen::Vector2d low(kMargin, kMargin);
  const Eigen::Vector2d high = s.size - low;
  AddBox(low, high, s);
  const double top = kMargin + kTitleHeight;
  const double middle = high.x() - kScaleWidth;
  s.lines.push_back({{low.x(), top}, {high.x(), top}});
  s.lines.push_back({{middle, low.y()}, {middle, top}});
  const double left = low.x() + 4;
  s.texts.push_back({{left, top - 9}, kLargeText, settings.title});
  s.texts.push_back({{left, low.y() + 3}, kSmallText, settings.subtitle});
  s.texts.push_back({{middle + 4, top - 6}, 3.5, s.scale_text});
  AddScaleBar({middle + 4, low.y() + 3}, s);
}

Status TooLarge(const Eigen::Vector2d& needed,
                const SheetSettings& settings,
                double denominator) {
  return Status::InvalidArgument(
      "At " + ScaleText(denominator) + " the drawing takes " +
      Short(std::ceil(needed.x())) + " x " + Short(std::ceil(needed.y())) +
      " mm, more than " + 'A' + settings.paper.substr(1) +
      " has; use a larger --paper or a smaller --scale");
}

}  // namespace

std::optional<double> ParseScale(std::string_view text) {
  const std::size_t colon = text.find(':');
  const bool is_ratio = colon != std::string_view::npos;
  const auto paper =
      is_ratio ? ParseNumber<double>(text.substr(0, colon)) : 1.0;
  const auto world =
      ParseNumber<double>(is_ratio ? text.substr(colon + 1) : text);
  if (!paper || !world) return std::nullopt;
  const double denominator = *world / *paper;
  if (!(*paper > 0 && denominator > 0 && std::isfinite(denominator))) {
    return std::nullopt;
  }
  return denominator;
}

Eigen::AlignedBox2d BoundsOf(const std::vector<SheetCurve>& curves) {
  constexpr int kSteps = 64;
  Eigen::AlignedBox2d bounds;
  for (const SheetCurve& curve : curves) {
    const CurveFit& fit = curve.fit;
    const int steps = fit.kind == FitKind::kLine ? 1 : kSteps;
    for (int i = 0; i <= steps; ++i) {
      bounds.extend(
          PointAt(fit, static_cast<double>(i) / steps).head<2>().eval());
    }
  }
  return bounds;
}

Result<Sheet> LaySheet(const SheetSettings& settings,
                       std::vector<SheetCurve> curves,
                       std::optional<SheetPicture> picture) {
  Eigen::AlignedBox2d bounds = BoundsOf(curves);
  if (bounds.isEmpty() || !(bounds.sizes().maxCoeff() > 0)) {
    return Status::InvalidArgument(
        "There is nothing to draw; no curve lies in the window");
  }
  const double mm = settings.millimetres;
  if (!(mm > 0) && settings.denominator > 0) {
    return Status::InvalidArgument(
        "--scale needs curves in mm, cm, m, in or ft; give them a unit with "
        "'colmap_curvix align --distance ... --unit mm'");
  }
  Sheet sheet;
  sheet.size = PaperSize(settings.paper);
  sheet.unit = settings.unit;
  const double around =
      kMargin + kGap + (settings.has_dimensions ? kDimensionRoom : 0);
  const Eigen::Vector2d room =
      sheet.size - Eigen::Vector2d(2 * around, 2 * around + kTitleHeight);
  const double fitting = (room.array() / bounds.sizes().array()).minCoeff();
  double denominator = settings.denominator;
  if (mm > 0) {
    if (!(denominator > 0)) denominator = 1 / RoundDown(fitting / mm);
    sheet.scale = mm / denominator;
    sheet.denominator = denominator;
    sheet.scale_text =
        ScaleText(denominator) + " on " + 'A' + settings.paper.substr(1);
  } else {
    sheet.scale = RoundDown(fitting);
    sheet.scale_text = "no scale; 1 unit is " + Short(sheet.scale) + " mm";
  }
  const Eigen::Vector2d taken = sheet.scale * bounds.sizes();
  if ((taken.array() > room.array() * (1 + 1e-9)).any()) {
    return TooLarge(taken + sheet.size - room, settings, denominator);
  }
  const Eigen::Vector2d middle(sheet.size.x() / 2,
                               (sheet.size.y() + kTitleHeight) / 2);
  sheet.corner = bounds.center() - middle / sheet.scale;
  AddTitle(settings, sheet);
  sheet.curves = std::move(curves);
  sheet.picture = std::move(picture);
  return sheet;
}

namespace {

constexpr double kMinGap = 0.3;          // of the longer side of the main part
constexpr double kMaxShareBeyond = 0.1;  // of the length

struct WeightedBox {
  Eigen::AlignedBox2d bounds;
  double length = 0;  // of the curve, nearly
};

// Of one axis, what the curves take without a break: the run with most length.
// Ties: the lowest.
Eigen::Vector2d HeaviestRun(int axis, std::vector<WeightedBox> boxes) {
  std::ranges::sort(boxes, {}, [&](const WeightedBox& box) {
    return box.bounds.min()[axis];
  });
  Eigen::Vector2d heaviest, run;
  double most = -1;
  double length = -1;
  for (const WeightedBox& box : boxes) {
    const double low = box.bounds.min()[axis];
    const double high = box.bounds.max()[axis];
    if (length < 0 || low > run.y()) {
      run = {low, high};
      length = 0;
    }
    run.y() = std::max(run.y(), high);
    length += box.length;
    if (length > most) {
      most = length;
      heaviest = run;
    }
  }
  return heaviest;
}

// From `main` on, with what follows without a large gap.
Eigen::AlignedBox2d Grown(Eigen::AlignedBox2d main,
                          const std::vector<WeightedBox>& boxes) {
  for (bool has_grown = true; has_grown;) {
    has_grown = false;
    const double gap = kMinGap * main.sizes().maxCoeff();
    for (const WeightedBox& box : boxes) {
      if (main.contains(box.bounds)) continue;
      const Eigen::Array2d apart = (box.bounds.min() - main.max())
                                       .cwiseMax(main.min() - box.bounds.max());
      if ((apart > gap).any()) continue;
      main.extend(box.bounds);
      has_grown = true;
    }
  }
  return main;
}

}  // namespace

Eigen::AlignedBox2d MainBoundsOf(const std::vector<SheetCurve>& curves) {
  std::vector<WeightedBox> boxes;
  double length = 0;
  for (const SheetCurve& curve : curves) {
    const Eigen::AlignedBox2d bounds = BoundsOf({curve});
    boxes.push_back({bounds, bounds.diagonal().norm()});
    length += boxes.back().length;
  }
  if (boxes.empty()) return {};
  Eigen::AlignedBox2d main;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d run = HeaviestRun(axis, boxes);
    main.min()[axis] = run.x();
    main.max()[axis] = run.y();
  }
  main = Grown(main, boxes);
  double beyond = 0;
  for (const WeightedBox& box : boxes) {
    if (!main.contains(box.bounds)) beyond += box.length;
  }
  return beyond > kMaxShareBeyond * length ? BoundsOf(curves) : main;
}

}  // namespace curvix
