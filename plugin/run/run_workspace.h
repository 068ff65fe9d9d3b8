// SPDX-License-Identifier: BSD-3-Clause
// The whole job: a COLMAP workspace, and maybe lines of another program, in,
// files with curves out.
#pragma once

#include <curvix/fitting.h>
#include <curvix/status.h>
#include <functional>
#include <vector>

#include "plugin/base/progress.h"
#include "plugin/imports/read_lines.h"
#include "plugin/run/run_report.h"
#include "plugin/run/run_stages.h"

namespace curvix {

// What a run leaves in memory.
struct WorkspaceRun {
  RunRecord record;
  SceneStages stages;
  FittedCurves fitted;  // of its curves; none if there are none
};

// Reads the workspace, refines the poses, reconstructs, and writes what
// settings.output.formats name, edges.ply, report.json, project.ini and stages/
// into the output folder; if the poses were refined, also the model with the
// new ones, in sparse/; if COLMAP did that, its words, in bundle_adjuster.log.
// All of them appear at the end, over those of an earlier run, or none does.
// The inputs are read only.
//
// Without any curve this succeeds too, with num_curves = 0 and why_empty, and
// writes report.json, project.ini, what belongs to the poses, and edges.ply if
// there are 3D edges. Curves and drawings of an earlier run go, since they are
// not of these options.
//
// kInvalidArgument and kNotFound: the workspace, or an output folder that
// cannot be used; kDataLoss and kUnsupported: broken or foreign files;
// kCancelled: interrupted. What the file system throws is left to the caller,
// as by all runs (file_errors.h).
Result<WorkspaceRun> RunWorkspace(const RunSettings& settings,
                                  RunProgress& progress);

using LinesSource = std::function<Result<std::vector<ImportedLine>>()>;

// Reads the workspace and, by `read`, lines in its world, fits them, and writes
// what settings.output.formats name and report.json into the output folder, as
// RunWorkspace does: all or nothing. The poses stay as they are, and there is
// no project.ini. Errors as those of RunWorkspace, `read` and CurvesOfLines.
Result<RunRecord> RunLines(const RunSettings& settings,
                           const LinesSource& read,
                           RunProgress& progress);

}  // namespace curvix
