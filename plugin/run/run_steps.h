// SPDX-License-Identifier: BSD-3-Clause
// The first and last step of every run: what there is to reconstruct, and what
// was found, in files.
#pragma once

#include <curvix/curves.h>
#include <curvix/fitting.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "base/stopwatch.h"
#include "colmap/workspace.h"
#include "plugin/base/progress.h"
#include "plugin/base/staged_output.h"
#include "plugin/run/run_report.h"

namespace curvix {

// FindWorkspace for the paths of `settings`. kInvalidArgument, too, if the
// results would lie among the inputs or behind a link (CheckOutputLinks).
Result<Workspace> FindInput(const RunSettings& settings);

// The same for what goes on from the results of an earlier run: unless
// `settings` name the images, they are those of that run, if they are there.
Result<Workspace> FindInputOfResults(RunSettings settings);

// The scene of the workspace, with the model of refined poses that an earlier
// run has left beside its results, if there is one. Errors of
// LoadWorkspaceScene.
Result<WorkspaceScene> ReadRefinedScene(Workspace workspace);

// Reads the model of `workspace`, and alignment.json if the folder of results
// has one; puts into `record` which folders and what they hold. Errors of
// LoadWorkspaceScene, CheckOutput and ReadAlignment.
Result<WorkspaceScene> ReadInput(const Workspace& workspace,
                                 RunProgress& progress,
                                 RunRecord& record);

// The output of a run. StagedOutput::Create(), and kInvalidArgument if it would
// replace a folder that no earlier run wrote.
Result<StagedOutput> CreateOutput(const Workspace& workspace);

// Fits the curves: the stage "fit_curves" of `record`.
FittedCurves FitCurvesOf(const Scene& scene,
                         const CurveSource& curves,
                         RunRecord& record);

// What a run has found.
struct Findings {
  const CurveSource& curves;
  std::int64_t num_edges_3d = 0;
  std::function<Status(const std::filesystem::path&)> write_edges =
      nullptr;                 // those
  std::string why_empty = "";  // "" when there are curves
  bool is_repeatable = true;   // by project.ini, which is written then
};

// Fits the curves, which it returns in the frame of the model, and writes the
// files that record.settings asks for into `folder`: those of the curves, if
// there are any, in the frame of record.alignment, and edges.ply, if there are
// 3D edges, in that of the model. Puts into `record` what was found and which
// files tell of it; the folder and the number of 2D edges are there already.
Result<FittedCurves> WriteFindings(const Scene& scene,
                                   const Findings& findings,
                                   const std::filesystem::path& folder,
                                   RunRecord& record);

// Writes report.json of a run that began with `since_start`, and publishes its
// files, in place of those of the run before in this folder and of drawings of
// its curves. kCancelled, and nothing is published, if the run is to stop.
Status FinishRun(const Stopwatch& since_start,
                 StagedOutput& output,
                 RunProgress& progress,
                 RunRecord& record);

}  // namespace curvix
