// SPDX-License-Identifier: BSD-3-Clause
// The last step of every run: what was found, in files.
#pragma once

#include <curvix/edges.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <curvix/stopwatch.h>

#include <filesystem>
#include <vector>

#include "plugin/progress.h"
#include "plugin/run_report.h"

namespace curvix {

// Puts into `result` what was found; the folder, the files and the number of 2D
// edges stay.
void Summarize(const Reconstruction& reconstruction, ResultSummary& result);

// Fits the curves, and writes the files that record.settings asks for into
// `folder`: those of the curves, if there are any, and edges.ply, if there are
// 3D edges. Puts into `record` what was found and which files tell of
// it; the folder and the number of 2D edges are there already.
Status WriteReconstruction(const Scene& scene,
                           const std::vector<EdgeMap>& edge_maps,
                           const Reconstruction& reconstruction,
                           const std::filesystem::path& folder,
                           RunRecord& record);

// Writes report.json of a run that began with `since_start`.
Status WriteReport(const Stopwatch& since_start,
                   const std::filesystem::path& folder,
                   ProgressPrinter& progress,
                   RunRecord& record);

}  // namespace curvix
