// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/exclusive_support.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "edge_sketch/evidence.h"
#include "geometry/pixel_size.h"
#include "model/contours.h"

namespace curvix {
namespace {

// A contour is sampled every pixel or less.
constexpr int kLinksAlongContour = 2;
constexpr double kSamePlacePx = 0.5;
constexpr double kSamePlaceSigmas = 4;
constexpr std::int32_t kNobody = -1;

// The 3D edge that has claimed each 2D edge.
class Claims {
 public:
  Claims(const std::vector<Edge3d>& edges,
         const std::vector<PosedView>& views,
         const std::vector<EdgeMap>& edge_maps)
      : edges_(edges),
        edge_maps_(edge_maps),
        pixel_sizes_(PixelSizes(edges, views)) {
    for (const EdgeMap& map : edge_maps) {
      owners_.emplace_back(map.edges.size(), kNobody);
    }
  }

  int NumOwnSupports(std::size_t edge_idx) const {
    const std::vector<EdgeRef>& support = edges_[edge_idx].support;
    return static_cast<int>(
        std::ranges::count_if(support, [&](const EdgeRef& ref) {
          const std::int32_t owner =
              owners_[static_cast<std::size_t>(ref.view_idx)]
                     [static_cast<std::size_t>(ref.edge_idx)];
          return owner == kNobody ||
                 AreAtSamePlace(edge_idx, static_cast<std::size_t>(owner));
        }));
  }

  void Claim(std::size_t edge_idx) {
    for (const EdgeRef& ref : edges_[edge_idx].support) {
      ClaimOne(ref, edge_idx);
      ForEachAlongContour(
          edge_maps_[static_cast<std::size_t>(ref.view_idx)].neighbors,
          ref.edge_idx,
          kLinksAlongContour,
          [&](std::int32_t other) {
            ClaimOne({ref.view_idx, other}, edge_idx);
          });
    }
  }

 private:
  bool AreAtSamePlace(std::size_t i, std::size_t k) const {
    const Edge3d& edge = edges_[i];
    const Edge3d& other = edges_[k];
    const Eigen::Vector3d offset = other.position - edge.position;
    const double across =
        (offset - edge.tangent * edge.tangent.dot(offset)).norm();
    return across <= kSamePlacePx * pixel_sizes_[i] +
                         kSamePlaceSigmas * std::hypot(edge.sigma, other.sigma);
  }

  void ClaimOne(const EdgeRef& ref, std::size_t edge_idx) {
    std::int32_t& owner = owners_[static_cast<std::size_t>(ref.view_idx)]
                                 [static_cast<std::size_t>(ref.edge_idx)];
    if (owner == kNobody) owner = static_cast<std::int32_t>(edge_idx);
  }

  const std::vector<Edge3d>& edges_;
  const std::vector<EdgeMap>& edge_maps_;
  std::vector<double> pixel_sizes_;
  std::vector<std::vector<std::int32_t>> owners_;
};

}  // namespace

std::vector<Edge3d> DropWithoutExclusiveSupport(
    std::vector<Edge3d> edges,
    const std::vector<PosedView>& views,
    const std::vector<EdgeMap>& edge_maps,
    int min_num_exclusive_views) {
  Claims claims(edges, views, edge_maps);
  std::vector<bool> keeps(edges.size(), false);
  for (const std::size_t i : ByFallingEvidence(edges)) {
    keeps[i] = claims.NumOwnSupports(i) >= min_num_exclusive_views;
    if (keeps[i]) claims.Claim(i);
  }
  // In place: there may be many.
  std::size_t num_kept = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!keeps[i]) continue;
    if (i != num_kept) edges[num_kept] = std::move(edges[i]);
    ++num_kept;
  }
  edges.resize(num_kept);
  return edges;
}

}  // namespace curvix
