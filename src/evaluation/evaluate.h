// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 7 (accuracy, completeness, precision, recall, F-score, IoU); the
// other measures are ours.
//
// How well curves agree with known ones. Both are compared as point sets: the
// truth as it is given, the curves resampled every `step` along their
// polylines, so that it does not matter how densely they were sampled.
#pragma once

#include <curvix/curves.h>
#include <curvix/status.h>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "evaluation/ground_truth.h"

namespace curvix {

struct EvaluationOptions {
  // Distance of the samples taken from the curves; world units, > 0. For IoU
  // and duplication to mean what they say it should be that of the truth.
  double step = 0.002;
  // A true sample counts as visible if this many views show an edge there.
  int min_num_views = 4;
  // Millimetres per world unit, > 0: all thresholds are in millimetres.
  double unit_mm = 1000;
};

// Lengths by the kind that the curves are said to be, mm.
using LengthPerKind = std::array<double, kNumCurveKinds>;

// The results for the true curves of one kind.
struct TrueKind {
  CurveKind kind = CurveKind::kUnknown;
  double length_mm = 0;          // true
  double visible_length_mm = 0;  // of it
  // Percent of the visible length within 5 mm of any curve.
  std::optional<double> visible_recall_5;
  // Predicted length whose nearest true sample is within 5 mm and of this kind.
  LengthPerKind predicted_mm = {};
  // Percent of that which is said to be of this kind.
  std::optional<double> right;
};

struct KindAgreement {
  std::vector<TrueKind> kinds;  // those of the truth, ascending
  // Predicted length further than 5 mm from the truth.
  LengthPerKind elsewhere_mm = {};
  // Percent of the predicted length near truth of a known kind that is said to
  // be of that kind; unknown is wrong. Absent, too, if no kind is said at all.
  std::optional<double> right;
};

// Shares of samples that are closer than a threshold to the other set, percent.
struct Agreement {
  double threshold_mm = 0;
  double precision = 0;  // P: of the predicted samples
  double recall = 0;     // R: of the true samples
  double f_score = 0;    // 2 P R / (P + R)
  // With p predicted and t true samples that agree, of np and nt:
  // min(p, t) / (np + nt - max(p, t)).
  double iou = 0;
};

// Absent: the truth lacks the column, or there is nothing to measure.
struct Evaluation {
  std::size_t num_predicted = 0;  // samples
  std::size_t num_true = 0;
  std::array<Agreement, 3> agreement = {{{5}, {10}, {20}}};  // thresholds, mm

  std::optional<double> accuracy_mm;      // mean distance predicted -> true
  std::optional<double> completeness_mm;  // mean distance true -> predicted

  // Over the visible samples of the truth (all, without view counts).
  std::optional<double> visible_completeness_mm;
  std::optional<double> visible_recall_5;   // percent within 5 mm
  std::optional<double> visible_recall_10;  // percent within 10 mm
  std::optional<double> visible_f_score_5;  // of precision and recall at 5 mm

  // Median angle between tangents, of predicted samples within 5 mm. Degrees.
  std::optional<double> tangent_deg;
  // Predicted length within 5 mm of the truth / true length recalled at 5 mm:
  // 1 if every curve is drawn once.
  std::optional<double> duplication;
  // Percent of the true curves with at least 10 mm of visible length of which
  // one predicted curve reaches 90 % of the visible samples within 5 mm.
  std::optional<double> whole;
  // Percent of the predicted samples within 5 mm of the truth that belong to
  // the main true curve of their predicted curve. True curves that continue
  // each other within 15 degrees at touching ends (1.5 mm) count as one, and a
  // sample near several curves counts for each.
  std::optional<double> pure;
  std::size_t num_curves = 0;  // predicted, with at least one sample
  // True curves so joined, with at least 10 mm of visible length.
  std::optional<std::size_t> num_true_curves;
  std::optional<KindAgreement> kinds;  // the truth has curve ids and kinds
};

// kInvalidArgument if an option is out of range, there is no truth, or the
// curves are so long that they need more than 10^8 samples. No curves are a
// valid, bad result.
Result<Evaluation> EvaluateCurves(const CurveSet& curves,
                                  const GroundTruth& truth,
                                  const EvaluationOptions& options);

}  // namespace curvix
