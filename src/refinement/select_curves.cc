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

constexpr double kLeastScatterPx = 0.06;
// Scatter, in units of that of good curves, that asks for no more evidence.
constexpr double kOrdinaryScatter = 3;
// The standard deviation of an edge's place that the sigmas of samples assume,
// where the scatter is not larger.
constexpr double kAssumedScatterPx = 0.15;

using AllTraits = std::vector<std::optional<CurveTraits>>;

double Squared(double x) { return x * x; }

// Not yet for scatter. `least_scatter`: that of good curves, or less.
double NeededEvidence(const CurveTraits& traits,
                      double least_scatter,
                      const CurveRefinementOptions& options) {
  const double scatter = std::max(traits.scatter_px, least_scatter);
  const double sigma_px =
      traits.sigma_px * std::min(1.0, scatter / kAssumedScatterPx);
  return options.min_evidence *
         Squared(std::max(1.0, sigma_px / options.sigma_scale_px));
}

bool IsBlurred(const CurveTraits& traits,
               const CurveRefinementOptions& options) {
  return traits.blurred_share > options.max_blurred_share;
}

// The scatter of good curves.
double TypicalScatter(const std::vector<Curve>& curves,
                      const AllTraits& all_traits,
                      const CurveRefinementOptions& options) {
  std::vector<std::pair<double, double>> scatter_and_length;
  double total = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto& traits = all_traits[i];
    if (!traits || IsBlurred(*traits, options) ||
        traits->evidence < NeededEvidence(*traits, kLeastScatterPx, options)) {
      continue;
    }
    scatter_and_length.emplace_back(traits->scatter_px, Length(curves[i]));
    total += scatter_and_length.back().second;
  }
  std::sort(scatter_and_length.begin(), scatter_and_length.end());
  double sum = 0;
  for (const auto& [scatter, length] : scatter_and_length) {
    sum += length;
    if (sum >= total / 4) return std::max(kLeastScatterPx, scatter);
  }
  return kLeastScatterPx;
}

enum class Verdict { kEdge, kOccludingContour, kNone };

Verdict Judge(const CurveTraits& traits,
              double typical_scatter,
              const CurveRefinementOptions& options) {
  if (IsBlurred(traits, options)) return Verdict::kNone;
  if (traits.evidence < options.min_evidence) return Verdict::kNone;
  const double scatter =
      traits.scatter_px / (kOrdinaryScatter * typical_scatter);
  const double needed = NeededEvidence(traits, typical_scatter, options) *
                        Squared(std::max(1.0, scatter));
  return traits.evidence >= needed ? Verdict::kEdge
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
  const double typical_scatter = TypicalScatter(curves, all_traits, options);
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
