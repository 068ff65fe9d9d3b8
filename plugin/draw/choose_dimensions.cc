// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/choose_dimensions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "base/angles.h"
#include "base/text_fields.h"
#include "measuring/known_directions.h"

namespace curvix {
namespace {

constexpr int kMost = 10;
constexpr double kAlikeSigmas = 3;

std::string Text(const MeasuredDimension& m) {
  const double digits = -std::floor(std::log10(m.sigma));
  return (m.drawn.is_radius ? "R" : "") +
         FixedText(m.drawn.value,
                   static_cast<int>(std::clamp(digits, 0.0, 9.0)));
}

bool AreAlike(const MeasuredDimension& a, const MeasuredDimension& b) {
  const Eigen::Vector2d u = (a.drawn.b - a.drawn.a).normalized();
  const Eigen::Vector2d v = (b.drawn.b - b.drawn.a).normalized();
  const bool are_parallel = std::abs(u.x() * v.y() - u.y() * v.x()) <
                            std::sin(DegToRad(kParallelDeg));
  return a.drawn.is_radius == b.drawn.is_radius &&
         (a.drawn.is_radius || are_parallel) &&
         std::abs(a.drawn.value - b.drawn.value) <
             kAlikeSigmas * std::hypot(a.sigma, b.sigma);
}

Eigen::Vector2d MiddleOf(const MeasuredDimension& m) {
  return (m.drawn.a + m.drawn.b) / 2;
}

}  // namespace

std::optional<MeasuredDimension> DimensionOf(const CurveFit& fit,
                                             const CurveFit& flat,
                                             double scale_sigma) {
  MeasuredDimension m;
  if (fit.kind == FitKind::kLine) {
    if (fit.start_node < 0 || fit.end_node < 0) return std::nullopt;
    m.drawn.value = Length(fit);
    const double sigma = DistanceSigma(
        fit.end - fit.start, fit.start_covariance, fit.end_covariance);
    m.sigma = std::hypot(sigma, scale_sigma * m.drawn.value);
    m.drawn.a = flat.start.head<2>();
    m.drawn.b = flat.end.head<2>();
    if (m.drawn.value - Length(flat) > m.sigma) return std::nullopt;
  } else if (fit.kind == FitKind::kArc && flat.kind == FitKind::kArc) {
    m.drawn.value = fit.major.norm();
    m.sigma = std::hypot(fit.radius_sigma, scale_sigma * m.drawn.value);
    m.drawn.is_radius = true;
    m.drawn.a = flat.center.head<2>();
    m.drawn.b = PointAt(flat, flat.closed ? 0.125 : 0.5).head<2>();
  } else {
    return std::nullopt;
  }
  if (!(m.sigma > 0) || !std::isfinite(m.sigma)) return std::nullopt;
  m.drawn.text = Text(m);
  return m;
}

std::vector<SheetDimension> ChooseDimensions(
    const std::vector<MeasuredDimension>& measured) {
  Eigen::AlignedBox2d bounds;
  for (const MeasuredDimension& m : measured) bounds.extend(MiddleOf(m));
  std::vector<MeasuredDimension> sorted = measured;
  std::ranges::stable_sort(
      sorted, std::ranges::greater(), [](const MeasuredDimension& m) {
        return m.drawn.value;
      });
  std::vector<MeasuredDimension> chosen;
  for (const MeasuredDimension& m : sorted) {
    const auto alike =
        std::ranges::find_if(chosen, [&](auto& c) { return AreAlike(c, m); });
    if (alike == chosen.end()) {
      const auto count = std::ranges::count_if(chosen, [&](auto& c) {
        return c.drawn.is_radius == m.drawn.is_radius;
      });
      if (count < kMost) chosen.push_back(m);
    } else if (!m.drawn.is_radius &&
               (MiddleOf(m) - bounds.center()).norm() >
                   (MiddleOf(*alike) - bounds.center()).norm()) {
      *alike = m;
    }
  }
  std::vector<SheetDimension> dimensions;
  for (MeasuredDimension& m : chosen) dimensions.push_back(std::move(m.drawn));
  return dimensions;
}

}  // namespace curvix
