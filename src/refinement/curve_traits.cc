// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/curve_traits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "base/median.h"
#include "geometry/adjust_edge.h"
#include "geometry/image_edge.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

// Half as blurred again in variance as an edge of the view is as a rule ...
constexpr double kBlurred = 0.7;
// ... and so many standard deviations more blurred than edges of the view are.
constexpr double kBlurredSigmas = 5;
constexpr double kSigmasOfLowerQuartile = 0.6745;
constexpr double kSigmasOfMedianDistance = 1.4826;

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
    const Edge2d& edge =
        edge_maps[view_idx].edges[static_cast<std::size_t>(ref.edge_idx)];
    const Eigen::Vector3d in_camera = views[view_idx].InCamera(sample.position);
    if (!(in_camera.z() > 0)) continue;
    const Eigen::Vector2d offset =
        views[view_idx].Pixel(in_camera) - edge.position;
    const Eigen::Vector2d tangent = ToImageEdge(edge).tangent;
    support.distances_px.push_back(
        std::abs(offset.x() * tangent.y() - offset.y() * tangent.x()));
    support.sharpness[ref.view_idx].push_back(
        static_cast<double>(edge.sharpness));
  }
}

// If all views that look at the sample had an edge where it is projected.
// Infinite, if less than two look at it.
double LeastDilution(const CurveSample& sample,
                     const std::vector<PosedView>& views) {
  const SpaceEdge edge{sample.position, sample.tangent};
  std::vector<PlaneMeasurement> measurements;
  for (const PosedView& view : views) {
    const auto projected = ProjectEdge(view, edge);
    if (projected && view.Contains(projected->position)) {
      measurements.push_back(MeasurePlane(view, *projected));
    }
  }
  if (measurements.size() < 2) return std::numeric_limits<double>::infinity();
  const double pixel = PixelSize(sample.position, sample.support, views);
  const Eigen::Matrix2d covariance =
      AdjustEdge(edge, measurements, 1).covariance;
  return std::sqrt(covariance.trace() / 2) / pixel;
}

double BlurredShare(const Support& support,
                    const std::vector<double>& least_sharpness) {
  double num_blurred = 0;
  double num_edges = 0;
  for (const auto& [view_idx, sharpness] : support.sharpness) {
    const double count = static_cast<double>(sharpness.size());
    num_edges += count;
    if (Median(sharpness) <
        least_sharpness[static_cast<std::size_t>(view_idx)]) {
      num_blurred += count;
    }
  }
  return num_edges > 0 ? num_blurred / num_edges : 0;
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

}  // namespace

std::vector<double> LeastSharpness(const std::vector<EdgeMap>& edge_maps) {
  std::vector<double> least;
  for (const EdgeMap& map : edge_maps) {
    least.push_back(LeastSharpness(map.edges));
  }
  return least;
}

std::optional<CurveTraits> MeasureCurve(
    const Curve& curve,
    const std::vector<PosedView>& views,
    const std::vector<EdgeMap>& edge_maps,
    const std::vector<double>& least_sharpness,
    double edge_sigma_px) {
  std::vector<double> dilutions;
  Support support;
  for (const CurveSample& sample : curve.samples) {
    const double pixel = PixelSize(sample.position, sample.support, views);
    if (!(sample.sigma > 0) || !(pixel > 0)) continue;
    dilutions.push_back(sample.sigma / (edge_sigma_px * pixel));
    AddSupport(sample, views, edge_maps, support);
  }
  if (support.distances_px.empty()) return std::nullopt;
  CurveTraits traits;
  traits.dilution = Median(std::move(dilutions));
  traits.least_dilution =
      LeastDilution(curve.samples[curve.samples.size() / 2], views);
  traits.blurred_share = BlurredShare(support, least_sharpness);
  traits.scatter_px =
      kSigmasOfMedianDistance * Median(std::move(support.distances_px));
  return traits;
}

}  // namespace curvix
