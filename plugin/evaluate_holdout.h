// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). `evaluate --holdout_every`: the curves of a
// workspace against those of its own photographs that were held out.
#pragma once

#include <curvix/holdout.h>
#include <curvix/status.h>

#include <iosfwd>

#include "plugin/evaluate.h"
#include "plugin/progress.h"
#include "plugin/run_report.h"

namespace curvix {

// Prints a table for people, or one JSON object with the keys held_out,
// support, chance, median_px, projections, expected_support, expected_chance,
// expected_median_px, expected_projections, curves, length.
void PrintHoldout(const Holdout& holdout,
                  EvaluationFormat format,
                  std::ostream& out);

// Reads the workspace, reconstructs without the held-out views, measures and
// prints. Poses are taken as they are. Nothing is written to disk. Fails as
// RunWorkspace and EvaluateHoldout do.
Status RunHoldout(const RunSettings& settings,
                  const HoldoutOptions& options,
                  EvaluationFormat format,
                  ProgressPrinter& progress,
                  std::ostream& out);

}  // namespace curvix
