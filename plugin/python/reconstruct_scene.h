// SPDX-License-Identifier: BSD-3-Clause
// A run without a workspace: from a scene, or its edges, to curves in memory.
#pragma once

#include <curvix/edges.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <vector>

#include "plugin/run/progress.h"
#include "plugin/run/run_workspace.h"

namespace curvix {

// The stages of RunWorkspace behind bundle adjustment, which is for models of
// COLMAP: edges, unless `edges` has them, one map per view, whose neighbours
// are looked for as among detected ones; poses refined with curves, if
// settings.poses says so; curves and fits. Nothing is written. Errors as
// ReconstructCurves.
Result<WorkspaceRun> ReconstructScene(const Scene& scene,
                                      const std::vector<EdgeMap>* edges,
                                      const RunSettings& settings,
                                      RunProgress& progress);

}  // namespace curvix
