// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/select_curves.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "refinement/curve_traits.h"

namespace curvix {
namespace {

// Sampling by pixels leaves as much.
constexpr double kLeastScatterPx = 0.06;
// Curves of a smaller share of blurred edges tell how far good curves scatter.
constexpr double kSharp = 0.1;
// Where the views cannot tell more, curves may be as dilute as this ...
constexpr double kTimesLeastDilution = 6;
// ... but no more than that.
constexpr double kMostTimesMaxDilution = 1.6;

using AllTraits = std::vector<std::optional<CurveTraits>>;

// The scatter of good curves.
double TypicalScatter(const std::vector<Curve>& curves,
                      const AllTraits& all_traits) {
  std::vector<std::pair<double, double>> scatter_and_weight;
  double total = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto& traits = all_traits[i];
    if (!traits || traits->blurred_share >= kSharp) continue;
    const double weight =
        Length(curves[i]) / (traits->dilution * traits->dilution);
    scatter_and_weight.emplace_back(traits->scatter_px, weight);
    total += weight;
  }
  std::sort(scatter_and_weight.begin(), scatter_and_weight.end());
  double sum = 0;
  for (const auto& [scatter, weight] : scatter_and_weight) {
    sum += weight;
    if (sum >= total / 4) return std::max(kLeastScatterPx, scatter);
  }
  return kLeastScatterPx;
}

enum class Verdict { kEdge, kOccludingContour, kNone };

Verdict Judge(const CurveTraits& traits,
              double typical_scatter,
              const CurveRefinementOptions& options) {
  if (options.max_dilution == 0) return Verdict::kEdge;
  const double sharpness = 1 - traits.blurred_share / options.max_blurred_share;
  if (sharpness <= 0) return Verdict::kNone;
  const double scatter = std::max(1.0, traits.scatter_px / typical_scatter);
  const double allowed =
      std::clamp(kTimesLeastDilution * traits.least_dilution,
                 options.max_dilution,
                 kMostTimesMaxDilution * options.max_dilution);
  return traits.dilution * scatter <= allowed * sharpness
             ? Verdict::kEdge
             : Verdict::kOccludingContour;
}

}  // namespace

SelectedCurves SelectCurves(std::vector<Curve> curves,
                            const std::vector<PosedView>& views,
                            const std::vector<EdgeMap>& edge_maps,
                            const CurveRefinementOptions& options,
                            int num_threads) {
  const std::vector<double> sharpness = TypicalSharpness(edge_maps);
  AllTraits all_traits(curves.size());
  ParallelFor(curves.size(), num_threads, [&](std::size_t i) {
    all_traits[i] = MeasureCurve(curves[i], views, edge_maps, sharpness);
  });
  const double typical_scatter = TypicalScatter(curves, all_traits);
  SelectedCurves selected;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Verdict verdict =
        all_traits[i] ? Judge(*all_traits[i], typical_scatter, options)
                      : Verdict::kEdge;
    if (verdict == Verdict::kEdge) {
      selected.edges.push_back(std::move(curves[i]));
    } else if (verdict == Verdict::kOccludingContour) {
      curves[i].is_occluding_contour = true;
      selected.occluding_contours.push_back(std::move(curves[i]));
    }
  }
  return selected;
}

}  // namespace curvix
