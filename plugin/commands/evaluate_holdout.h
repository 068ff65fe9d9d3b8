// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). `evaluate --holdout_every`: curves against those
// images of a workspace that had no part in them.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <iosfwd>

#include "evaluation/evaluate.h"
#include "evaluation/holdout.h"
#include "plugin/run/progress.h"
#include "plugin/run/run_report.h"

namespace curvix {

struct HoldoutResult {
  int num_held_out = 0;  // views
  ResultSummary curves;
  ImageAgreement agreement;
};

// Prints a table for people, or one JSON object: held_out, curves, length,
// piece_px, and in percent precision, precision_chance, precision_lift, the
// same of expected_precision, strong and lines.
void PrintHoldout(const HoldoutResult& result,
                  EvaluationFormat format,
                  std::ostream& out);

// Reads the workspace, reconstructs without one of `every` views, compares with
// the images of these, and prints. Poses are taken as they are. With a
// `curves_path`, these curves are compared, whoever made them, and nothing is
// reconstructed. Nothing is written to disk. Fails as RunWorkspace,
// ReconstructWithHoldout, ReadCurves and CompareWithImages do.
Status RunHoldout(const RunSettings& settings,
                  const std::filesystem::path& curves_path,
                  int every,
                  EvaluationFormat format,
                  RunProgress& progress,
                  std::ostream& out);

}  // namespace curvix
