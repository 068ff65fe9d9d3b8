// SPDX-License-Identifier: BSD-3-Clause
// Evaluations as a table and as JSON: against known curves, and
// `--holdout_every`: against those images of a workspace that had no part in
// the curves.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <string>

#include "evaluation/evaluate.h"
#include "evaluation/holdout.h"
#include "evaluation/image_agreement.h"
#include "plugin/base/progress.h"
#include "plugin/run/run_report.h"

namespace curvix {

// A table for people, or one JSON object with the keys acc, comp, compv, P5,
// R5, F5, IoU5 (10, 20 alike), Rv5, Rv10, Fv5, tangent, dup, whole, pure,
// curves, gt_curves, predicted, gt; what is absent is null. `kinds`, where the
// truth has them: `right`, percent; `elsewhere`, mm by the kind said; and for
// each true kind length, length_visible, Rv5, right and `said`, mm by kind.
std::string EvaluationText(const Evaluation& evaluation, bool json);

// Reads both files, evaluates, and returns EvaluationText().
Result<std::string> EvaluateFiles(const std::filesystem::path& curves_path,
                                  const std::filesystem::path& truth_path,
                                  const EvaluationOptions& options,
                                  bool json);

// Reads the workspace, reconstructs without one of `every` views, compares with
// the images of these, and returns a table for people, or one JSON object:
// held_out, curves, length, piece_px, model, alignment ("": none), and in
// percent precision, precision_chance, precision_lift, the same of
// expected_precision (absent: no curve says which images show it), strong and
// lines. Poses are taken as they are. With a `curves_path`, these curves are
// compared, whoever made them, and nothing is reconstructed; the sparse/ beside
// them comes before the workspace's model, but not before the input_path of
// `settings`, and the alignment.json beside them is their frame. Nothing is
// written to disk. Fails as RunWorkspace, ReconstructWithHoldout, ReadCurves
// and CompareWithImages do.
Result<std::string> RunHoldout(const RunSettings& settings,
                               const std::filesystem::path& curves_path,
                               int every,
                               bool json,
                               RunProgress& progress);

}  // namespace curvix
