// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "base/angles.h"
#include "base/median.h"
#include "base/point_tree.h"
#include "evaluation/resample_curves.h"

namespace curvix {
namespace {

constexpr double kNearMm = 5;  // what counts as the same place

// Both sets, and distances between them.
struct Comparison {
  std::vector<CurveStep> predicted;
  std::vector<TrueSample> truth;
  std::vector<bool> visible;           // per true sample
  std::vector<double> predicted_mm;    // distances predicted -> true
  std::vector<double> true_mm;         // distances true -> predicted
  std::vector<std::size_t> true_idxs;  // the nearest, per predicted sample
  std::optional<PointTree> predicted_tree, true_tree;
  double near = 0;  // kNearMm in world units
  double unit_mm = 0;
};

std::size_t Index(CurveKind kind) { return static_cast<std::size_t>(kind); }

std::optional<double> Percent(double part, double whole) {
  if (!(whole > 0)) return std::nullopt;
  return 100 * part / whole;
}

// Lengths and recall of the truth, for every kind.
std::array<TrueKind, kNumCurveKinds> MeasureTruth(const Comparison& c,
                                                  double sample_mm) {
  std::array<TrueKind, kNumCurveKinds> kinds;
  std::array<double, kNumCurveKinds> found_mm = {};
  for (std::size_t i = 0; i < c.truth.size(); ++i) {
    const std::size_t kind = Index(c.truth[i].kind);
    kinds[kind].length_mm += sample_mm;
    if (!c.visible[i]) continue;
    kinds[kind].visible_length_mm += sample_mm;
    if (c.true_mm[i] < kNearMm) found_mm[kind] += sample_mm;
  }
  for (std::size_t i = 0; i < kNumCurveKinds; ++i) {
    kinds[i].kind = static_cast<CurveKind>(i);
    kinds[i].visible_recall_5 =
        Percent(found_mm[i], kinds[i].visible_length_mm);
  }
  return kinds;
}

constexpr double kMinLengthMm = 10;   // shorter true curves are not counted
constexpr double kMaxGapMm = 1.5;     // between the ends of touching curves
constexpr double kMinCoverage = 0.9;  // of a curve that is drawn as a whole
constexpr double kMaxNumSteps = 1e8;

Status Check(const CurveSet& curves,
             const GroundTruth& truth,
             const EvaluationOptions& options) {
  if (!(options.step > 0) || !std::isfinite(options.step)) {
    return Status::InvalidArgument(
        "The step of the evaluation must be a finite number > 0.");
  }
  if (!(options.unit_mm > 0) || !std::isfinite(options.unit_mm)) {
    return Status::InvalidArgument(
        "The millimetres per world unit must be a finite number > 0.");
  }
  if (truth.samples.empty()) {
    return Status::InvalidArgument("There is no ground truth to compare with.");
  }
  const double num_steps = CountSteps(curves, options.step);
  if (num_steps > 0 && num_steps < 1) {
    return Status::InvalidArgument(
        "The step of the evaluation is longer than all curves together; choose "
        "a shorter one.");
  }
  if (!(num_steps <= kMaxNumSteps)) {
    return Status::InvalidArgument(
        "The curves are too long for this step of the evaluation; choose a "
        "longer one.");
  }
  return {};
}

void CompareNearest(Comparison& c) {
  c.true_tree.emplace(c.truth, &TrueSample::position);
  for (const CurveStep& step : c.predicted) {
    const auto nearest = c.true_tree->Nearest(step.position);
    c.predicted_mm.push_back(nearest.distance * c.unit_mm);
    c.true_idxs.push_back(nearest.index);
  }
  c.predicted_tree.emplace(c.predicted, &CurveStep::position);
  for (const TrueSample& sample : c.truth) {
    const auto nearest = c.predicted_tree->Nearest(sample.position);
    c.true_mm.push_back(nearest.distance * c.unit_mm);
  }
}

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double CountBelow(const std::vector<double>& values, double threshold) {
  const auto below = [threshold](double value) { return value < threshold; };
  return static_cast<double>(std::ranges::count_if(values, below));
}

double PercentBelow(const std::vector<double>& values, double threshold) {
  return 100 * CountBelow(values, threshold) /
         static_cast<double>(values.size());
}

double FScore(double precision, double recall) {
  return 2 * precision * recall / std::max(precision + recall, 1e-12);
}

Agreement MeasureAgreement(const Comparison& c, double threshold_mm) {
  Agreement result{threshold_mm};
  result.precision = PercentBelow(c.predicted_mm, threshold_mm);
  result.recall = PercentBelow(c.true_mm, threshold_mm);
  result.f_score = FScore(result.precision, result.recall);
  const auto [fewer, more] =
      std::minmax({CountBelow(c.predicted_mm, threshold_mm),
                   CountBelow(c.true_mm, threshold_mm)});
  const double sum =
      static_cast<double>(c.predicted_mm.size() + c.true_mm.size());
  result.iou = 100 * fewer / (sum - more);
  return result;
}

void MeasureVisible(const Comparison& c, Evaluation& result) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < c.truth.size(); ++i) {
    if (c.visible[i]) distances.push_back(c.true_mm[i]);
  }
  if (distances.empty()) return;
  result.visible_completeness_mm = Mean(distances);
  result.visible_recall_5 = PercentBelow(distances, 5);
  result.visible_recall_10 = PercentBelow(distances, 10);
  result.visible_f_score_5 =
      FScore(result.agreement[0].precision, *result.visible_recall_5);
}

std::optional<double> MedianTangentAngle(const Comparison& c) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < c.predicted.size(); ++i) {
    if (c.predicted_mm[i] >= kNearMm) continue;
    const Eigen::Vector3d& tangent = c.truth[c.true_idxs[i]].tangent;
    const double cosine = std::abs(c.predicted[i].tangent.dot(tangent));
    angles.push_back(RadToDeg(std::acos(std::min(cosine, 1.0))));
  }
  if (angles.empty()) return std::nullopt;
  return MedianOrNan(std::move(angles));
}

// The distance of neighbouring samples of the truth.
std::optional<double> TrueSpacing(const std::vector<TrueSample>& truth) {
  std::vector<double> distances;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    if (truth[i].curve_id != truth[i - 1].curve_id) continue;
    distances.push_back((truth[i].position - truth[i - 1].position).norm());
  }
  if (distances.empty()) return std::nullopt;
  return MedianOrNan(std::move(distances));
}

std::size_t MaxVotes(const std::map<std::size_t, std::size_t>& votes) {
  std::size_t most = 0;
  for (const auto& [key, count] : votes) most = std::max(most, count);
  return most;
}

void MeasureWhole(const Comparison& c,
                  const std::vector<int>& groups,
                  double spacing,
                  Evaluation& result) {
  std::map<int, std::vector<std::size_t>> visible_of_curve;
  for (std::size_t i = 0; i < c.truth.size(); ++i) {
    if (c.visible[i]) visible_of_curve[c.truth[i].curve_id].push_back(i);
  }
  std::size_t num_curves = 0;
  std::size_t num_whole = 0;
  std::set<int> counted_groups;
  for (const auto& [id, visible] : visible_of_curve) {
    const auto size = static_cast<double>(visible.size());
    if (size * spacing * c.unit_mm < kMinLengthMm) continue;
    ++num_curves;
    counted_groups.insert(groups[visible[0]]);
    std::map<std::size_t, std::size_t> votes;  // per predicted curve
    for (const std::size_t i : visible) {
      std::set<std::size_t> touching;
      for (const std::size_t k :
           c.predicted_tree->Within(c.truth[i].position, c.near)) {
        touching.insert(c.predicted[k].curve_idx);
      }
      for (const std::size_t curve_idx : touching) ++votes[curve_idx];
    }
    num_whole +=
        static_cast<double>(MaxVotes(votes)) >= kMinCoverage * size ? 1 : 0;
  }
  result.num_true_curves = counted_groups.size();
  if (num_curves == 0) return;
  result.whole =
      100 * static_cast<double>(num_whole) / static_cast<double>(num_curves);
}

std::optional<double> MeasurePure(const Comparison& c,
                                  const std::vector<int>& groups) {
  // Per predicted curve, votes for the groups of true curves that it touches.
  std::map<std::size_t, std::map<std::size_t, std::size_t>> votes_of_curve;
  std::size_t num_near = 0;
  for (std::size_t i = 0; i < c.predicted.size(); ++i) {
    if (c.predicted_mm[i] >= kNearMm) continue;
    ++num_near;
    std::set<int> touching;
    for (const std::size_t k :
         c.true_tree->Within(c.predicted[i].position, c.near)) {
      touching.insert(groups[k]);
    }
    auto& votes = votes_of_curve[c.predicted[i].curve_idx];
    for (const int group : touching) ++votes[static_cast<std::size_t>(group)];
  }
  if (num_near == 0) return std::nullopt;
  std::size_t num_pure = 0;
  for (const auto& [curve, votes] : votes_of_curve) num_pure += MaxVotes(votes);
  return 100 * static_cast<double>(num_pure) / static_cast<double>(num_near);
}

// `step` and `spacing`: the lengths that one predicted and one true sample
// stand for, world units.
void MeasureCurves(const Comparison& c,
                   double step,
                   double spacing,
                   Evaluation& result) {
  const double recalled = CountBelow(c.true_mm, kNearMm) * spacing;
  if (recalled > 0) {
    result.duplication = CountBelow(c.predicted_mm, kNearMm) * step / recalled;
  }
  const std::vector<int> groups = SmoothGroups(c.truth, kMaxGapMm / c.unit_mm);
  MeasureWhole(c, groups, spacing, result);
  result.pure = MeasurePure(c, groups);
}

std::size_t CountCurves(const std::vector<CurveStep>& steps) {
  std::set<std::size_t> curves;
  for (const CurveStep& step : steps) curves.insert(step.curve_idx);
  return curves.size();
}

// `step` and `spacing` as above.
KindAgreement MeasureKinds(const Comparison& c, double step, double spacing) {
  auto kinds = MeasureTruth(c, spacing * c.unit_mm);
  const double step_mm = step * c.unit_mm;
  KindAgreement result;
  for (std::size_t i = 0; i < c.predicted.size(); ++i) {
    const CurveKind true_kind = c.truth[c.true_idxs[i]].kind;
    LengthPerKind& lengths = c.predicted_mm[i] < kNearMm
                                 ? kinds[Index(true_kind)].predicted_mm
                                 : result.elsewhere_mm;
    lengths[Index(c.predicted[i].kind)] += step_mm;
  }
  const bool has_kinds = std::ranges::any_of(
      c.predicted,
      [](const auto& sample) { return sample.kind != CurveKind::kUnknown; });
  double all_mm = 0;
  double right_mm = 0;
  for (TrueKind& kind : kinds) {
    if (kind.length_mm == 0) continue;
    if (has_kinds && kind.kind != CurveKind::kUnknown) {
      const double near_mm = std::accumulate(
          kind.predicted_mm.begin(), kind.predicted_mm.end(), 0.0);
      const double same_mm = kind.predicted_mm[Index(kind.kind)];
      kind.right = Percent(same_mm, near_mm);
      all_mm += near_mm;
      right_mm += same_mm;
    }
    result.kinds.push_back(kind);
  }
  result.right = Percent(right_mm, all_mm);
  return result;
}

}  // namespace

Result<Evaluation> EvaluateCurves(const CurveSet& curves,
                                  const GroundTruth& truth,
                                  const EvaluationOptions& options) {
  CURVIX_RETURN_IF_ERROR(Check(curves, truth, options));
  Comparison c;
  c.predicted = Resample(curves, options.step);
  c.truth = truth.samples;
  c.unit_mm = options.unit_mm;
  c.near = kNearMm / options.unit_mm;
  for (const TrueSample& sample : truth.samples) {
    c.visible.push_back(!truth.has_views ||
                        sample.num_views_edge >= options.min_num_views);
  }
  Evaluation result;
  result.num_predicted = c.predicted.size();
  result.num_true = c.truth.size();
  if (c.predicted.empty()) {
    if (std::ranges::find(c.visible, true) != c.visible.end()) {
      result.visible_recall_5 = result.visible_recall_10 = 0;
      result.visible_f_score_5 = 0;
    }
    if (truth.has_curve_ids) result.whole = 0;
    return result;
  }

  CompareNearest(c);
  result.accuracy_mm = Mean(c.predicted_mm);
  result.completeness_mm = Mean(c.true_mm);
  for (Agreement& agreement : result.agreement) {
    agreement = MeasureAgreement(c, agreement.threshold_mm);
  }
  MeasureVisible(c, result);
  if (truth.has_tangents) result.tangent_deg = MedianTangentAngle(c);
  const std::optional<double> spacing = TrueSpacing(c.truth);
  if (truth.has_curve_ids && spacing) {
    MeasureCurves(c, options.step, *spacing, result);
  }
  if (truth.has_kinds && spacing) {
    result.kinds = MeasureKinds(c, options.step, *spacing);
  }
  result.num_curves = CountCurves(c.predicted);
  return result;
}

}  // namespace curvix
