// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4. The 3D edge sketch: hypothesise, consolidate, validate.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/scene.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// What became of the H1 edges and their hypotheses.
struct SketchCounts {
  std::int64_t view_pairs = 0;
  std::int64_t h1_edges = 0;     // asked for hypotheses
  std::int64_t hypotheses = 0;   // after consolidation (Sec. 4)
  std::int64_t unsupported = 0;  // hypotheses that other views did not confirm
  std::int64_t rivals = 0;       // confirmed, but far weaker than another
  std::int64_t used_edges = 0;   // 2D edges that formed or support a 3D edge
};

struct EdgeSketch {
  std::vector<Edge3d> edges;
  SketchCounts counts;
};

// Called with (done, total); false stops early.
using StepDone = std::function<bool(int, int)>;

// Chooses hypothesis views as options.hypotheses.view_selection says, and
// judges support as options.validation.support_test says.
EdgeSketch SketchEdges(const std::vector<PosedView>& views,
                       const std::vector<EdgeMap>& edge_maps,
                       const std::vector<ScenePoint>& points,
                       const Options& options,
                       const StepDone& step_done);

}  // namespace curvix
