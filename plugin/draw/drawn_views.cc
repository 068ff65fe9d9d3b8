// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/drawn_views.h"

#include <curvix/curves.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "base/angles.h"
#include "base/text_fields.h"
#include "drawing/cut_fit.h"
#include "drawing/flat_fit.h"

namespace curvix {
namespace {

// "low, ..., high, ...": `count` numbers of which those of the first half are
// below those of the second. Empty: it is not that.
std::vector<double> ParseBox(std::string_view text, std::size_t count) {
  const std::vector<double> numbers = ParseNumbers(text, count);
  for (std::size_t i = 0; i < numbers.size() / 2; ++i) {
    if (!(numbers[i] < numbers[i + count / 2])) return {};
  }
  return numbers;
}

Status BadOption(const std::string& option,
                 const std::string& text,
                 const std::string& what) {
  return Status::InvalidArgument(option + " is \"" + text + "\"; it takes " +
                                 what);
}

constexpr double kSideDeg = 45;
constexpr int kLeastViews = 3;
constexpr double kLeastShare = 0.1;
constexpr std::size_t kMostSamples = 16;

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

Result<DrawWindow> ParseWindow(const std::string& slice,
                               const std::string& crop) {
  DrawWindow window;
  if (!slice.empty()) {
    const std::vector<double> box = ParseBox(slice, 2);
    if (box.empty()) {
      return BadOption("--slice",
                       slice,
                       "the lower and the higher depth, as in --slice 0.9,1.1");
    }
    window.depth = {box[0], box[1]};
  }
  if (!crop.empty() && crop != "all") {
    const std::vector<double> box = ParseBox(crop, 4);
    if (box.empty()) {
      return BadOption("--crop",
                       crop,
                       "left, bottom, right and top, in the coordinates of the "
                       "drawing, as in --crop 0,0,2.5,3, or all");
    }
    window.across = {box[0], box[2]};
    window.upwards = {box[1], box[3]};
  }
  return window;
}

std::vector<CurveFit> PartsInWindow(const CurveFit& fit,
                                    const DrawingPlane& plane,
                                    const DrawWindow& window) {
  std::vector<CurveFit> parts = {fit};
  for (const auto& [axis, range] : {std::pair(plane.depth_axis, window.depth),
                                    std::pair(plane.right, window.across),
                                    std::pair(plane.up, window.upwards)}) {
    const double at_0 = axis.dot(plane.origin);
    std::vector<CurveFit> within;
    for (const CurveFit& part : parts) {
      for (CurveFit& piece :
           PartsWithin(part, axis, range.from + at_0, range.to + at_0)) {
        within.push_back(std::move(piece));
      }
    }
    parts = std::move(within);
  }
  return parts;
}

SeenFrom SeenFromSide(const CurveFit& fit,
                      const std::vector<SeenSample>& samples,
                      const Eigen::Vector3d& toward,
                      const Scene& scene) {
  const std::size_t count = std::min(fit.num_samples, kMostSamples);
  int num_views = 0, num_showing = 0;
  for (std::size_t i = 0; i < count; ++i) {
    // The middles of equal stretches.
    const std::size_t at = fit.num_samples * (2 * i + 1) / (2 * count);
    const SeenSample& sample =
        samples[(fit.first_sample + at) % samples.size()];
    for (const View& view : scene.views) {
      const Eigen::Vector3d ray =
          view.cam_from_world.Inverse().translation - sample.position;
      const Camera& camera = CameraOf(scene, view);
      if (ray.dot(toward) < std::cos(DegToRad(kSideDeg)) * ray.norm() ||
          !ProjectPoint(sample.position, view, camera)) {
        continue;
      }
      ++num_views;
      num_showing +=
          std::ranges::binary_search(sample.image_ids, view.image_id) ? 1 : 0;
    }
  }
  if (num_views < kLeastViews * static_cast<int>(count)) {
    return SeenFrom::kUnknown;
  }
  return num_showing < kLeastShare * num_views ? SeenFrom::kHidden
                                               : SeenFrom::kSeen;
}

FittedCurves WithoutHidden(const CurvesFile& curves,
                           const Eigen::Vector3d& toward,
                           const Scene& scene) {
  FittedCurves shown = curves.fitted;
  for (std::size_t c = 0; c < shown.curves.size(); ++c) {
    std::erase_if(shown.curves[c].fits, [&](const CurveFit& fit) {
      return SeenFromSide(fit, curves.samples[c], toward, scene) ==
             SeenFrom::kHidden;
    });
  }
  return shown;
}

void FillViews(const DrawnContent& content, std::vector<DrawnView>* views) {
  for (DrawnView& view : *views) {
    Fill(content, view);
    if (content.leaves_out_far) LeaveOutFar(content, view);
  }
  PlaceViews(content, *views);
}

}  // namespace curvix
