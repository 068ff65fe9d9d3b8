// SPDX-License-Identifier: BSD-3-Clause
// Lines of another program in, the files of a run out.
#pragma once

#include <curvix/status.h>
#include <functional>
#include <vector>

#include "plugin/base/progress.h"
#include "plugin/imports/read_lines.h"
#include "plugin/run/run_report.h"

namespace curvix {

// Reads the workspace and, by `read`, lines in its world, fits them, and writes
// what settings.output.formats name and report.json into the output folder, as
// RunWorkspace does: all or nothing. The poses stay as they are, and there is
// no project.ini. Errors as those of RunWorkspace, `read` and CurvesOfLines.
Result<RunRecord> RunLines(
    const RunSettings& settings,
    const std::function<Result<std::vector<ImportedLine>>()>& read,
    ProgressPrinter& progress);

}  // namespace curvix
