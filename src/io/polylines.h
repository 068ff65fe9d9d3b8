// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves from the segments of a file.
#pragma once

#include <curvix/curves.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace curvix {

// Segments between numbered vertices, as a file lists them.
struct LineGraph {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3d> tangents;  // one per vertex, or none at all
  // Kinds and their probabilities; one per vertex, or none at all.
  std::vector<std::pair<CurveKind, float>> kinds;
  std::vector<std::array<std::int64_t, 2>> edges;  // from, to: vertex numbers
};

// Follows the segments through vertices of degree two: an open polyline runs
// between two vertices of another degree (ends and junctions, the smaller
// number first), a closed one starts where its first edge starts. Curves are
// ordered by their first edge, so that what EncodePlyLines writes comes back as
// it was. Repeated edges and edges from a vertex to itself are dropped;
// vertices without edges belong to no curve. Tangents that are missing or zero
// are taken from the neighbouring samples.
//
// kDataLoss if an edge names a vertex that is not there or a position is not
// finite. Time O(n log n).
Result<CurveSet> JoinPolylines(const LineGraph& graph);

}  // namespace curvix
