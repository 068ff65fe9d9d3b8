// SPDX-License-Identifier: BSD-3-Clause
// From posed images, or from posed edges, to curves.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace curvix {

// What one stage did: how much it took, how much it gave, what it lost and why.
struct StageReport {
  std::string name;  // "sketch_edges", say
  double wall_seconds = 0;
  double cpu_seconds = 0;     // of the whole process
  double peak_memory_mb = 0;  // of the process so far
  // In the order in which they were counted: ("edges", 170000), ...
  std::vector<std::pair<std::string, std::int64_t>> counts;
};

struct Report {
  std::vector<StageReport> stages;
  // Empty when there are curves; else a sentence that says why there are none
  // and what may help.
  std::string why_empty;
};

// Called from one thread at a time: `stage` has finished `done` of `total`
// steps (0: not known). False asks the run to stop with StatusCode::kCancelled.
using Progress =
    std::function<bool(const std::string& stage, int done, int total)>;

struct Reconstruction {
  CurveSet curves;
  std::vector<Edge3d> edges;  // before grouping into curves (Sec. 5)
  Report report;
};

// Detects the third-order edges of every view (Sec. 3, ref. [15]) and carries
// them to the ideal pinhole. Fails if an image is missing, broken, or not of
// its camera's size.
Result<std::vector<EdgeMap>> DetectEdges(const Scene& scene,
                                         const Options& options,
                                         const Progress& progress = {});

// The paper's Secs. 3 to 6 on edges that are already there: one map per view,
// in the ideal pinhole of the view's camera. Needs at least three views.
Result<Reconstruction> ReconstructCurves(const Scene& scene,
                                         const std::vector<EdgeMap>& edge_maps,
                                         const Options& options = {},
                                         const Progress& progress = {});

// The two parts of that, for a run in pieces: Secs. 3 and 4, and the rest. The
// report of the second part begins where the first ended.
Result<EdgeSketch> SketchEdges(const Scene& scene,
                               const std::vector<EdgeMap>& edge_maps,
                               const Options& options,
                               const Progress& progress = {});
Result<Reconstruction> CurvesFromSketch(const Scene& scene,
                                        const std::vector<EdgeMap>& edge_maps,
                                        const EdgeSketch& sketch,
                                        const Options& options,
                                        const Progress& progress = {});

// For StageReport::counts.
std::vector<std::pair<std::string, std::int64_t>> CountsOf(
    const EdgeSketch& sketch);

// Detection and all that follows. Same input, options and build give the same
// result for any number of threads.
Result<Reconstruction> ReconstructCurves(const Scene& scene,
                                         const Options& options = {},
                                         const Progress& progress = {});

}  // namespace curvix
