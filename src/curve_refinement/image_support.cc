// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/image_support.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/check.h"
#include "base/parallel.h"
#include "geometry/edge_geometry.h"
#include "geometry/nearest_edge.h"
#include "geometry/occluding_contour.h"

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

}  // namespace curvix
