// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which curves are edges of the scene.
#include "curve_refinement/refine_curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "base/infinity.h"
#include "base/median.h"
#include "base/parallel.h"
#include "curve_refinement/occluding_contours.h"
#include "geometry/adjust_edge.h"
#include "geometry/detected_edge.h"
#include "geometry/edge_geometry.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

// Half as blurred again in variance as an edge of the view is as a rule ...
constexpr double kBlurred = 0.7;
// ... and so many standard deviations more blurred than edges of the view are.
constexpr double kBlurredSigmas = 5;
constexpr double kSigmasOfLowerQuartile = 0.6745;
// Every third sample tells the dilution of sharp views.
constexpr std::size_t kSampleStep = 3;

// The edges behind a curve.
struct Support {
  std::vector<double> distances_px;
  std::map<std::int32_t, std::vector<double>> sharpness;  // by view
};

void AddSupport(const CurveSample& sample,
                const std::vector<PosedView>& views,
                const std::vector<EdgeMap>& edge_maps,
                Support& support) {
  for (const EdgeRef& ref : sample.support) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    const Edge2d& edge = EdgeOf(ref, edge_maps);
    const Eigen::Vector3d in_camera = views[view_idx].InCamera(sample.position);
    if (!(in_camera.z() > 0)) continue;
    const Eigen::Vector2d offset =
        views[view_idx].Pixel(in_camera) - edge.position;
    support.distances_px.push_back(std::abs(ToBrightSide(edge).dot(offset)));
    support.sharpness[ref.view_idx].push_back(
        static_cast<double>(edge.sharpness));
  }
}

// Of the place of a sample that is so measured, if edges have this sigma.
// Infinite with fewer than two measurements.
double DilutionOf(const CurveSample& sample,
                  const std::vector<PlaneMeasurement>& measurements,
                  double edge_sigma_px,
                  const std::vector<PosedView>& views) {
  if (measurements.size() < 2) return kInfinity;
  const Eigen::Matrix2d covariance =
      AdjustEdge({sample.position, sample.tangent}, measurements, edge_sigma_px)
          .covariance;
  return std::sqrt(covariance.trace() / 2) /
         (edge_sigma_px * PixelSize(sample, views));
}

// If all views that look at the sample had an edge where it is projected.
double LeastDilution(const CurveSample& sample,
                     const std::vector<PosedView>& views) {
  const SpaceEdge edge{sample.position, sample.tangent};
  std::vector<PlaneMeasurement> measurements;
  for (const PosedView& view : views) {
    const auto projected = ProjectInto(view, edge);
    if (projected) measurements.push_back(MeasurePlane(view, *projected));
  }
  return DilutionOf(sample, measurements, 1, views);
}

// Whether the curve is not blurred, by view.
std::vector<bool> AreSharp(const Support& support,
                           const std::vector<double>& least_sharpness) {
  std::vector<bool> are_sharp(least_sharpness.size(), true);
  for (const auto& [view_idx, sharpness] : support.sharpness) {
    const auto v = static_cast<std::size_t>(view_idx);
    are_sharp[v] = Median(sharpness) >= least_sharpness[v];
  }
  return are_sharp;
}

double BlurredShare(const Support& support,
                    const std::vector<bool>& are_sharp) {
  double num_blurred = 0;
  double num_edges = 0;
  for (const auto& [view_idx, sharpness] : support.sharpness) {
    const double count = static_cast<double>(sharpness.size());
    num_edges += count;
    if (!are_sharp[static_cast<std::size_t>(view_idx)]) num_blurred += count;
  }
  return num_edges > 0 ? num_blurred / num_edges : 0;
}

// By the edges of sharp views alone.
double SharpDilution(const CurveSample& sample,
                     const RefinementInput& input,
                     const std::vector<bool>& are_sharp) {
  std::vector<PlaneMeasurement> measurements;
  for (const EdgeRef& ref : sample.support) {
    const auto v = static_cast<std::size_t>(ref.view_idx);
    if (!are_sharp[v]) continue;
    measurements.push_back(MeasurePlane(
        input.views[v], ToImageEdge(EdgeOf(ref, input.edge_maps))));
  }
  return DilutionOf(sample, measurements, input.edge_sigma_px, input.views);
}

double SharpDilution(const Curve& curve,
                     const RefinementInput& input,
                     const std::vector<bool>& are_sharp) {
  std::vector<double> dilutions;
  for (std::size_t k = 0; k < curve.samples.size(); k += kSampleStep) {
    dilutions.push_back(SharpDilution(curve.samples[k], input, are_sharp));
  }
  return Median(std::move(dilutions));
}

double LeastSharpness(const std::vector<Edge2d>& edges) {
  if (edges.empty()) return 0;
  std::vector<double> strengths, sharpness;
  for (const Edge2d& edge : edges) {
    strengths.push_back(static_cast<double>(edge.strength));
  }
  const double median_strength = Median(std::move(strengths));
  for (const Edge2d& edge : edges) {
    if (static_cast<double>(edge.strength) < median_strength) continue;
    sharpness.push_back(static_cast<double>(edge.sharpness));
  }
  const auto quarter =
      sharpness.begin() + static_cast<std::ptrdiff_t>(sharpness.size() / 4);
  std::nth_element(sharpness.begin(), quarter, sharpness.end());
  const double lower_quartile = *quarter;
  const double typical = Median(std::move(sharpness));
  if (!(lower_quartile > 0)) return 0;
  // Sharpness is distributed log-normally.
  const double sigma =
      std::log(typical / lower_quartile) / kSigmasOfLowerQuartile;
  return typical * std::min(kBlurred, std::exp(-kBlurredSigmas * sigma));
}

// Of each view, how sharp a curve must be not to count as blurred: 0.7 of the
// median sharpness of the steeper half of its edges, or five standard
// deviations below it, if these differ more, as in photographs, of which some
// parts are out of focus. The standard deviation is that of the logarithm, from
// the lower quartile. 0 if it is not known: then nothing counts as blurred.
std::vector<double> LeastSharpness(const std::vector<EdgeMap>& edge_maps) {
  std::vector<double> least;
  for (const EdgeMap& map : edge_maps) {
    least.push_back(LeastSharpness(map.edges));
  }
  return least;
}

struct CurveTraits {
  // How many times less surely than one 2D edge, across it, the place of the
  // curve is known: the median over the samples of sigma in pixels
  // (pixel_size.h) over that of an edge. It falls with the number of supporting
  // views, and grows where their rays lie in one plane and where their edges
  // are off by more than edges should be.
  double dilution = 0;
  // That of the middle sample, if all views that look at it supported it,
  // exactly.
  double least_dilution = 0;
  // 1.48 times the median distance of the supporting edges from the projected
  // samples, which for normal errors is their standard deviation. Pixels.
  double scatter_px = 0;
  // The share of the supporting edges that lie in views in which this curve is
  // blurred: the median sharpness of its edges there is below
  // LeastSharpness(). 0..1.
  double blurred_share = 0;
  // The dilution that edges of the other views alone leave. Infinite, if fewer
  // than two of them support most samples.
  double sharp_dilution = 0;
};

// nullopt if no sample has both a sigma and support.
std::optional<CurveTraits> MeasureCurve(
    const Curve& curve,
    const RefinementInput& input,
    const std::vector<double>& least_sharpness) {
  const std::vector<PosedView>& views = input.views;
  std::vector<double> dilutions;
  Support support;
  for (const CurveSample& sample : curve.samples) {
    const double pixel = PixelSize(sample, views);
    if (!(sample.sigma > 0) || !(pixel > 0)) continue;
    dilutions.push_back(sample.sigma / (input.edge_sigma_px * pixel));
    AddSupport(sample, views, input.edge_maps, support);
  }
  if (support.distances_px.empty()) return std::nullopt;
  CurveTraits traits;
  traits.dilution = Median(std::move(dilutions));
  traits.least_dilution =
      LeastDilution(curve.samples[curve.samples.size() / 2], views);
  const std::vector<bool> are_sharp = AreSharp(support, least_sharpness);
  traits.blurred_share = BlurredShare(support, are_sharp);
  traits.sharp_dilution = traits.blurred_share > 0
                              ? SharpDilution(curve, input, are_sharp)
                              : traits.dilution;
  traits.scatter_px =
      kSigmasPerMedian * Median(std::move(support.distances_px));
  return traits;
}

// Sampling by pixels leaves as much.
constexpr double kLeastScatterPx = 0.06;
// Curves of a smaller share of blurred edges tell how far good curves scatter,
// if there are any.
constexpr double kSharp = 0.1;
// Where the views cannot tell more, curves may be as dilute as this ...
constexpr double kTimesLeastDilution = 6;
// ... but no more than that. In crowded images, where depth is less sure, that
// would drop edges that exist, as the ridge of a house.
constexpr double kMostTimesMaxDilution = 1.6;
constexpr double kTimesLeastDilutionInCrowd = 30;
// Curves are occluding contours, however well determined, where a radius is so
// much likelier than none (occluding_contours.h).
constexpr double kCertainLogLikelihoodRatio = 4;

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
  std::ranges::sort(scatter_and_weight);
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

enum class Verdict { kEdge, kOccludingContour, kShadingEdge };

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
              double contour_log_likelihood_ratio,
              const CurveRefinementOptions& options) {
  const double scatter = std::max(1.0, traits.scatter_px / typical_scatter);
  const double allowed = LargestDilution(traits, are_crowded, options) *
                         (1 - std::max(0.0, contour_log_likelihood_ratio) /
                                  kCertainLogLikelihoodRatio);
  if (traits.dilution * scatter > allowed) return Verdict::kOccludingContour;
  if (options.max_blurred_share == 1) return Verdict::kEdge;
  const double sharpness = 1 - traits.blurred_share / options.max_blurred_share;
  return sharpness > 0 && traits.sharp_dilution * scatter <= allowed * sharpness
             ? Verdict::kEdge
             : Verdict::kShadingEdge;
}

}  // namespace

SelectedCurves SelectCurves(std::vector<Curve> curves,
                            const RefinementInput& input,
                            const ImageSupport& images) {
  const CurveRefinementOptions& options = input.options;
  const std::vector<double> least_sharpness = LeastSharpness(input.edge_maps);
  AllTraits all_traits(curves.size());
  ParallelFor(curves.size(), input.num_threads, [&](std::size_t i) {
    all_traits[i] = MeasureCurve(curves[i], input, least_sharpness);
  });
  const double typical_scatter =
      TypicalScatter(curves, all_traits, options.max_blurred_share);
  const bool are_crowded = AreCrowded(input.edge_maps);
  std::vector<Verdict> verdicts(curves.size(), Verdict::kEdge);
  ParallelFor(curves.size(), input.num_threads, [&](std::size_t i) {
    if (!all_traits[i] || options.max_dilution == 0) return;
    const auto judge = [&](double contour_log_likelihood_ratio) {
      return Judge(*all_traits[i],
                   typical_scatter,
                   are_crowded,
                   contour_log_likelihood_ratio,
                   options);
    };
    verdicts[i] = judge(0);
    if (verdicts[i] != Verdict::kEdge || are_crowded) return;
    verdicts[i] = judge(
        ContourLogLikelihoodRatio(curves[i], images, input.edge_sigma_px));
  });
  SelectedCurves selected;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (verdicts[i] == Verdict::kEdge) {
      selected.edges.push_back(std::move(curves[i]));
    } else if (verdicts[i] == Verdict::kOccludingContour) {
      for (CurveSample& sample : curves[i].samples) {
        sample.kind = CurveKind::kOccludingContour;
        sample.kind_probability = 1;
      }
      selected.occluding_contours.push_back(std::move(curves[i]));
    }
  }
  return selected;
}

}  // namespace curvix
