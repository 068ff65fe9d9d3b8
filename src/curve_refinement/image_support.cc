// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/image_support.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/angles.h"
#include "base/check.h"
#include "base/infinity.h"
#include "base/parallel.h"
#include "geometry/adjust_edge.h"
#include "geometry/nearest_edge.h"

namespace curvix {
namespace {

constexpr double kCellPx = 4;

}  // namespace

Eigen::Vector3d MeanSide(const CurveSample& sample,
                         const std::vector<PosedView>& views) {
  std::vector<Eigen::Vector3d> centers;
  for (const EdgeRef& ref : sample.support) {
    centers.push_back(views[static_cast<std::size_t>(ref.view_idx)].center);
  }
  return MeanSide({sample.position, sample.tangent}, centers);
}

ImageSupport::ImageSupport(const std::vector<PosedView>& views,
                           const std::vector<EdgeMap>& edge_maps,
                           int num_threads)
    : views_(views), grids_(views.size()) {
  CURVIX_CHECK(edge_maps.size() == views.size(),
               edge_maps.size() << " edge maps of " << views.size());
  ParallelFor(views.size(), num_threads, [&](std::size_t v) {
    grids_[v] = GridIndex(edge_maps[v].edges, kCellPx);
  });
}

std::vector<EdgeRef> ImageSupport::Find(const SpaceEdge& edge) const {
  std::vector<EdgeRef> support;
  for (std::size_t v = 0; v < views_.size(); ++v) {
    const auto projected = ProjectInto(views_[v], edge);
    if (!projected) continue;
    const auto nearest = NearestEdge(grids_[v], *projected, Gate());
    if (nearest) support.push_back({static_cast<std::int32_t>(v), *nearest});
  }
  return support;
}

std::vector<double> ImageSupport::Beside(std::size_t view_idx,
                                         const ImageEdge& projected,
                                         double max_distance_px) const {
  const Gate gate{max_distance_px};
  // How far along the projected edge such edges are, and half the rectangle
  // around them, at most the square of max_distance_px.
  const double along_px =
      gate.tangential_px +
      max_distance_px * std::sqrt(1 - gate.min_cosine * gate.min_cosine);
  const Eigen::Vector2d direction = projected.tangent.cwiseAbs();
  const Eigen::Vector2d reach_px =
      (along_px * direction + max_distance_px * direction.reverse())
          .cwiseMin(max_distance_px);
  std::vector<double> distances;
  grids_[view_idx].VisitAround(
      projected.position, reach_px, [&](const IndexedEdge& edge) {
        Eigen::Vector2d tangent = edge.tangent.cast<double>();
        const double cosine = tangent.dot(projected.tangent);
        if (std::abs(cosine) < gate.min_cosine) return;
        if (cosine < 0) tangent = -tangent;
        const Eigen::Vector2d offset =
            edge.position.cast<double>() - projected.position;
        const double across =
            offset.y() * tangent.x() - offset.x() * tangent.y();
        if (std::abs(offset.dot(tangent)) > gate.tangential_px ||
            std::abs(across) > gate.normal_px) {
          return;
        }
        distances.push_back(across);
      });
  std::ranges::sort(distances);
  return distances;
}

namespace {

// The probability that a view shows a contour, or an edge, that exists.
constexpr double kShown = 0.5;
// Least number of other contours per pixel across the curve.
constexpr double kMinDensity = 0.02;
// So many edges of a contour are found beside a place.
constexpr double kEdgesPerContour = 2;
// A contour further away explains nothing: exp(-72) is lost beside 1 - kShown.
constexpr double kFarSigmas = 12;

}  // namespace

double NearestResidual(const std::vector<double>& edges_px, double at_px) {
  const auto above = std::ranges::lower_bound(edges_px, at_px);
  double nearest = above == edges_px.end() ? kInfinity : *above - at_px;
  if (above != edges_px.begin() && at_px - *(above - 1) < nearest) {
    nearest = *(above - 1) - at_px;
  }
  return nearest;
}

double LogLikelihoodOfContour(double residual_px,
                              double sigma_px,
                              double density) {
  if (!std::isfinite(residual_px)) return 0;
  const double r = residual_px / sigma_px;
  if (std::abs(r) > kFarSigmas) return std::log(1 - kShown);
  const double of_contour =
      std::exp(-0.5 * r * r) / (std::sqrt(2 * kPi) * sigma_px);
  return std::log(1 - kShown + kShown * of_contour / density);
}

double DensityOfContours(double num_edges, double num_views, double reach_px) {
  return std::max(kMinDensity,
                  num_edges / (kEdgesPerContour * 2 * reach_px * num_views));
}

}  // namespace curvix
