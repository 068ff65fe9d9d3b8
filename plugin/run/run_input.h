// SPDX-License-Identifier: BSD-3-Clause
// The first step of every run: what there is to reconstruct.
#pragma once

#include <curvix/status.h>

#include "colmap/workspace.h"
#include "plugin/run/progress.h"
#include "plugin/run/run_report.h"

namespace curvix {

// FindWorkspace for the paths of `settings`. kInvalidArgument, too, if the
// results would lie among the inputs.
Result<Workspace> FindInput(const RunSettings& settings);

// The same with the model of refined poses that an earlier run has left beside
// its results, if there is one.
Workspace WithRefinedModel(Workspace workspace);

// Reads the model of `workspace`, and alignment.json if the folder of results
// has one; puts into `record` which folders and what they hold. Errors of
// LoadWorkspaceScene and ReadAlignment.
Result<WorkspaceScene> ReadInput(const Workspace& workspace,
                                 RunProgress& progress,
                                 RunRecord& record);

}  // namespace curvix
