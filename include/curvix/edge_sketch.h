// SPDX-License-Identifier: BSD-3-Clause
// The 3D edge sketch: what the paper's Secs. 3 and 4 give to Secs. 5 and 6.
#pragma once

#include <curvix/edges.h>

#include <cstdint>
#include <vector>

namespace curvix {

// What became of the H1 edges and their hypotheses.
struct SketchCounts {
  std::int64_t view_pairs = 0;
  std::int64_t h1_edges = 0;     // asked for hypotheses
  std::int64_t hypotheses = 0;   // after consolidation (Sec. 4)
  std::int64_t unsupported = 0;  // hypotheses that other views did not confirm
  std::int64_t rivals = 0;       // confirmed, but another explains their edges
  // 2D edges that show a 3D edge or are next to one.
  std::int64_t used_edges = 0;
};

struct EdgeSketch {
  std::vector<Edge3d> edges;
  SketchCounts counts;
  // Standard deviation of the distance of a 2D edge from its 3D edge, as
  // estimated from the scene. Pixels, > 0.
  double edge_sigma_px = 0.15;
};

}  // namespace curvix
