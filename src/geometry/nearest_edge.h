// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(c). The edge of a view that a projected edge may be.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "base/angles.h"
#include "base/grid_index.h"
#include "geometry/edge_geometry.h"

namespace curvix {

// Bounds on where a place in the image may be, relative to an edge found. The
// defaults are those of an edge that a view shows.
struct Gate {
  double normal_px = 1;                        // from the edge's tangent line
  double tangential_px = 1;                    // along it
  double min_cosine = std::cos(DegToRad(15));  // between the directions
};

// The edge of `grid` inside `gate` that is nearest to `expected`, distances
// along the tangent counting half, of those whose indices `accept` takes; ties:
// smaller edge index.
template <typename F>
std::optional<std::int32_t> NearestEdge(const GridIndex& grid,
                                        const ImageEdge& expected,
                                        const Gate& gate,
                                        const F& accept) {
  const double reach = std::sqrt(gate.normal_px * gate.normal_px +
                                 gate.tangential_px * gate.tangential_px);
  std::optional<std::int32_t> nearest;
  double least = 0;
  const auto consider = [&](const IndexedEdge& edge) {
    const Eigen::Vector2d offset =
        edge.position.cast<double>() - expected.position;
    if (std::abs(offset.x()) > reach || std::abs(offset.y()) > reach) return;
    const Eigen::Vector2d tangent = edge.tangent.cast<double>();
    if (std::abs(tangent.dot(expected.tangent)) < gate.min_cosine) return;
    const double along = offset.dot(tangent);
    const double across = offset.x() * tangent.y() - offset.y() * tangent.x();
    if (std::abs(across) > gate.normal_px ||
        std::abs(along) > gate.tangential_px) {
      return;
    }
    if (!accept(edge.edge_idx)) return;
    const double distance2 = across * across + 0.25 * along * along;
    if (!nearest || distance2 < least ||
        (distance2 == least && edge.edge_idx < *nearest)) {
      nearest = edge.edge_idx;
      least = distance2;
    }
  };
  grid.VisitAround(expected.position, reach, consider);
  return nearest;
}

inline std::optional<std::int32_t> NearestEdge(const GridIndex& grid,
                                               const ImageEdge& expected,
                                               const Gate& gate) {
  return NearestEdge(grid, expected, gate, [](std::int32_t) { return true; });
}

}  // namespace curvix
