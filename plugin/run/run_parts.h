// SPDX-License-Identifier: BSD-3-Clause
// A scene in parts: planned, reconstructed part by part, and merged. Each step
// may run on another machine that sees the same files; each may run again, and
// gives the same bytes.
#pragma once

#include <curvix/status.h>

#include "parts/scene_parts.h"
#include "plugin/base/progress.h"
#include "plugin/run/run_report.h"

namespace curvix {

// Divides the scene of a workspace as PartitionScene() does, and writes parts/
// (part_files.h) into the folder of its results. If the same plan is there
// already, it stays, and so do the results of its parts; models that are gone
// come back. Errors as RunWorkspace and PartitionScene; kInvalidArgument, too,
// if parts of another plan are done.
Result<ScenePartition> RunPartition(const RunSettings& settings,
                                    int max_views_per_part,
                                    RunProgress& progress);

// Reconstructs one part, from its own model and images alone, with the poses
// that they have, and writes its part.bin, edges.ply and report.json, all or
// none. One run at a time works on a part. Errors as RunWorkspace; kNotFound,
// too, without plan or part.
Result<RunRecord> RunPart(const RunSettings& settings,
                          int part_idx,
                          RunProgress& progress);

// Merges the parts, and writes the files that RunWorkspace would write.
// Errors as RunWorkspace; kNotFound, too, if the model has changed since it was
// divided, or with the parts that are still to be reconstructed, or again
// because images, masks or options are others.
Result<RunRecord> RunMerge(const RunSettings& settings, RunProgress& progress);

}  // namespace curvix
