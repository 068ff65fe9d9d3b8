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
// Curves of a smaller share of blurred edges tell how far good curves scatter,
// if there are any.
constexpr double kSharp = 0.1;
// Where the views cannot tell more, curves may be as dilute as this ...
constexpr double kTimesLeastDilution = 6;
// ... but no more than that. In crowded images, where depth is less sure, any
// such limit takes what exists.
constexpr double kMostTimesMaxDilution = 1.6;
constexpr double kTimesLeastDilutionInCrowd = 15;

using AllTraits = std::vector<std::optional<CurveTraits>>;

// The lower quartile of the scatter of curves of a smaller share of blurred
// edges, weighted by length / dilution^2; nullopt if there are none.
std::optional<double> ScatterOfSharp(const std::vector<Curve>& curves,
                                     const AllTraits& all_traits,
                                     double blurred_share) {
  std::vector<std::pair<double, double>> scatter_and_weight;
  double total = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto& traits = all_traits[i];
    if (!traits || traits->blurred_share >= blurred_share) continue;
    const double weight =
        Length(curves[i]) / (traits->dilution * traits->dilution);
    scatter_and_weight.emplace_back(traits->scatter_px, weight);
    total += weight;
  }
  std::sort(scatter_and_weight.begin(), scatter_and_weight.end());
  double sum = 0;
  for (const auto& [scatter, weight] : scatter_and_weight) {
    sum += weight;
    if (sum >= total / 4) return scatter;
  }
  return std::nullopt;
}

// The scatter of good curves.
double TypicalScatter(const std::vector<Curve>& curves,
                      const AllTraits& all_traits,
                      double max_blurred_share) {
  for (const double share :
       {std::min(kSharp, max_blurred_share), max_blurred_share}) {
    const auto scatter = ScatterOfSharp(curves, all_traits, share);
    if (scatter) return std::max(kLeastScatterPx, *scatter);
  }
  return kLeastScatterPx;
}

enum class Verdict { kEdge, kOccludingContour, kBorderOfShading };

double LargestDilution(const CurveTraits& traits,
                       bool are_crowded,
                       const CurveRefinementOptions& options) {
  if (are_crowded) {
    return std::max(options.max_dilution,
                    kTimesLeastDilutionInCrowd * traits.least_dilution);
  }
  return std::clamp(kTimesLeastDilution * traits.least_dilution,
                    options.max_dilution,
                    kMostTimesMaxDilution * options.max_dilution);
}

Verdict Judge(const CurveTraits& traits,
              double typical_scatter,
              bool are_crowded,
              const CurveRefinementOptions& options) {
  if (options.max_dilution == 0) return Verdict::kEdge;
  const double dilution =
      traits.dilution * std::max(1.0, traits.scatter_px / typical_scatter);
  const double allowed = LargestDilution(traits, are_crowded, options);
  if (dilution > allowed) return Verdict::kOccludingContour;
  if (options.max_blurred_share == 1) return Verdict::kEdge;
  const double sharpness = 1 - traits.blurred_share / options.max_blurred_share;
  return sharpness > 0 && dilution <= allowed * sharpness
             ? Verdict::kEdge
             : Verdict::kBorderOfShading;
}

}  // namespace

SelectedCurves SelectCurves(std::vector<Curve> curves,
                            const std::vector<PosedView>& views,
                            const std::vector<EdgeMap>& edge_maps,
                            double edge_sigma_px,
                            const CurveRefinementOptions& options,
                            int num_threads) {
  const std::vector<double> least_sharpness = LeastSharpness(edge_maps);
  AllTraits all_traits(curves.size());
  ParallelFor(curves.size(), num_threads, [&](std::size_t i) {
    all_traits[i] = MeasureCurve(
        curves[i], views, edge_maps, least_sharpness, edge_sigma_px);
  });
  const double typical_scatter =
      TypicalScatter(curves, all_traits, options.max_blurred_share);
  const bool are_crowded = AreCrowded(edge_maps);
  SelectedCurves selected;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Verdict verdict =
        all_traits[i]
            ? Judge(*all_traits[i], typical_scatter, are_crowded, options)
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
