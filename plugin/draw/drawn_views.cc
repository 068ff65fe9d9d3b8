// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/drawn_views.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "drawing/flat_fit.h"
#include "plugin/draw/seen_from.h"

namespace curvix {
namespace {

// Between views on one sheet, of the extent of the largest.
constexpr double kGapOfViews = 0.15;
constexpr double kGapForDimensions = 0.35;

DrawRange Shifted(const DrawRange& range, double by) {
  return {range.from + by, range.to + by};
}

SeenFrom SeenInView(const DrawnContent& content,
                    std::size_t curve_idx,
                    const CurveFit& fit,
                    const DrawnView& view) {
  if (content.hidden == "solid") return SeenFrom::kSeen;
  return SeenFromSide(
      fit, content.curves.samples[curve_idx], view.plane.toward, content.scene);
}

double ScaleSigma(const DrawnContent& content) {
  return content.curves.alignment ? content.curves.alignment->scale_sigma() : 0;
}

// What the plane shows of the window.
void Fill(const DrawnContent& content, DrawnView& view) {
  const DrawingPlane& plane = view.plane;
  view.curves.clear();
  view.measured.clear();
  view.num_unknown = 0;
  for (std::size_t c = 0; c < content.curves.fitted.curves.size(); ++c) {
    for (const CurveFit& fit : content.curves.fitted.curves[c].fits) {
      const std::vector<CurveFit> parts =
          PartsInWindow(fit, plane, view.window);
      if (parts.empty()) continue;
      const SeenFrom seen = SeenInView(content, c, fit, view);
      const bool is_hidden = seen == SeenFrom::kHidden;
      if (is_hidden && content.hidden == "omitted") continue;
      for (const CurveFit& part : parts) {
        std::optional<CurveFit> flat = FlatFit(part, plane);
        if (!flat) continue;
        const bool is_whole =
            part.start == fit.start && part.end == fit.end &&
            (fit.kind == FitKind::kLine ||
             (content.curves.fitted.curves[c].fits.size() == 1 &&
              part.closed == fit.closed));
        if (content.has_dimensions && is_whole && !is_hidden) {
          const auto measured = DimensionOf(fit, *flat, ScaleSigma(content));
          if (measured) view.measured.push_back(*measured);
        }
        view.num_unknown += seen == SeenFrom::kUnknown ? 1 : 0;
        view.curves.push_back({*std::move(flat), is_hidden});
      }
    }
  }
}

void LeaveOutFar(const DrawnContent& content, DrawnView& view) {
  const Eigen::AlignedBox2d bounds = MainBoundsOf(view.curves);
  if (bounds.isEmpty() || bounds.contains(BoundsOf(view.curves))) return;
  view.num_far = static_cast<std::size_t>(
      std::ranges::count_if(view.curves, [&](const SheetCurve& curve) {
        return !bounds.contains(BoundsOf({curve}));
      }));
  // Bounds of arcs are those of some of their points. What is left out is much
  // further away than this.
  const double margin = 0.01 * bounds.sizes().maxCoeff();
  view.window.across = {bounds.min().x() - margin, bounds.max().x() + margin};
  view.window.upwards = {bounds.min().y() - margin, bounds.max().y() + margin};
  Fill(content, view);
}

void PlaceViews(const DrawnContent& content, std::vector<DrawnView>& views) {
  const DrawnView& first = views.front();
  const Eigen::AlignedBox2d around = BoundsOf(first.curves);
  Eigen::AlignedBox2d all = around;
  double extent = 0;
  for (const DrawnView& view : views) {
    const Eigen::AlignedBox2d bounds = BoundsOf(view.curves);
    if (!bounds.isEmpty()) extent = std::max(extent, bounds.sizes().maxCoeff());
  }
  const double gap =
      (content.has_dimensions ? kGapForDimensions : kGapOfViews) * extent;
  for (std::size_t i = 1; i < views.size(); ++i) {
    DrawnView& view = views[i];
    const Eigen::AlignedBox2d bounds = BoundsOf(view.curves);
    if (bounds.isEmpty() || around.isEmpty()) continue;
    Eigen::Vector2d shift;
    if (view.plane.right == first.plane.right) {
      const bool is_above = view.plane.toward == first.plane.up;
      shift = {0,
               is_above ? all.max().y() + gap - bounds.min().y()
                        : all.min().y() - gap - bounds.max().y()};
    } else {
      const bool is_left = view.plane.toward == -first.plane.right;
      const bool is_level = view.plane.up == first.plane.up;
      shift = {is_left ? all.min().x() - gap - bounds.max().x()
                       : all.max().x() + gap - bounds.min().x(),
               is_level ? 0 : around.min().y() - bounds.min().y()};
    }
    view.plane.origin -=
        shift.x() * view.plane.right + shift.y() * view.plane.up;
    view.window.across = Shifted(view.window.across, shift.x());
    view.window.upwards = Shifted(view.window.upwards, shift.y());
    Fill(content, view);
    all.extend(bounds.translated(shift));
  }
}

}  // namespace

void FillViews(const DrawnContent& content, std::vector<DrawnView>* views) {
  for (DrawnView& view : *views) {
    Fill(content, view);
    if (content.leaves_out_far) LeaveOutFar(content, view);
  }
  PlaceViews(content, *views);
}

}  // namespace curvix
