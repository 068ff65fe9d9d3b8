// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/undistort_edges.h"

#include <curvix/scene.h>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/check.h"
#include "geometry/detected_edge.h"
#include "geometry/lens.h"

namespace curvix {
namespace {

// `edge` in another image, into which `carry` carries what it can.
template <typename Carry>
std::optional<Edge2d> Carried(const Edge2d& edge, const Carry& carry) {
  ImageEdge place = ToImageEdge(edge);
  const std::optional<ImageEdge> to = carry(place);
  if (!to) return std::nullopt;
  Edge2d carried = edge;
  carried.position = to->position;
  carried.angle =
      static_cast<float>(std::atan2(to->tangent.y(), to->tangent.x()));
  if (edge.fine_px == Eigen::half(0)) return carried;
  place.position += static_cast<double>(edge.fine_px) * ToBrightSide(edge);
  if (const auto fine = carry(place)) {
    carried.fine_px = Eigen::half(static_cast<float>(
        (fine->position - to->position).dot(ToBrightSide(carried))));
  }
  return carried;
}

using NewIndices = std::vector<std::optional<std::int32_t>>;

std::optional<std::int32_t> Renumbered(const NewIndices& new_idx,
                                       std::optional<std::int32_t> old_idx) {
  if (!old_idx) return std::nullopt;
  return new_idx[static_cast<std::size_t>(*old_idx)];
}

}  // namespace

EdgeMap UndistortEdges(EdgeMap distorted, const Camera& camera) {
  CURVIX_CHECK(distorted.edges.size() == distorted.neighbors.size(),
               distorted.edges.size() << " edges");
  if (IsPinhole(camera)) return distorted;
  EdgeMap ideal = std::move(distorted);
  const std::vector<Edge2d> edges = std::exchange(ideal.edges, {});
  const std::vector<EdgeNeighbors> neighbors =
      std::exchange(ideal.neighbors, {});
  NewIndices new_idx(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto edge = Carried(edges[i], [&](const ImageEdge& in_image) {
      return EdgeInIdealImage(in_image, camera);
    });
    if (!edge) continue;
    new_idx[i] = static_cast<std::int32_t>(ideal.edges.size());
    ideal.edges.push_back(*edge);
  }
  ideal.neighbors.reserve(ideal.edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!new_idx[i]) continue;
    ideal.neighbors.push_back({Renumbered(new_idx, neighbors[i].previous),
                               Renumbered(new_idx, neighbors[i].next)});
  }
  return ideal;
}

std::optional<EdgeMap> CarryEdges(const EdgeMap& edges,
                                  const Camera& from,
                                  const Camera& to) {
  if (from == to) return edges;
  EdgeMap carried = edges;
  for (Edge2d& edge : carried.edges) {
    const auto moved = Carried(edge, [&](const ImageEdge& in_image) {
      return CarryEdge(in_image, from, to);
    });
    if (!moved) return std::nullopt;
    edge = *moved;
  }
  return carried;
}

std::int32_t DropMaskedEdges(const GrayImage& mask,
                             std::vector<LocatedEdge>* edges) {
  const auto is_masked = [&mask](const LocatedEdge& edge) {
    const double x = std::floor(edge.position.x());
    const double y = std::floor(edge.position.y());
    if (x < 0 || y < 0 || x >= mask.width || y >= mask.height) return false;
    return mask.at(static_cast<int>(x), static_cast<int>(y)) == 0;
  };
  return static_cast<std::int32_t>(std::erase_if(*edges, is_masked));
}

}  // namespace curvix
