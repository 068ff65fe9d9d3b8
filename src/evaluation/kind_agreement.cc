// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "evaluation/kind_agreement.h"

#include <numeric>

namespace curvix {
namespace {

std::size_t Index(CurveKind kind) { return static_cast<std::size_t>(kind); }

std::optional<double> Percent(double part, double whole) {
  if (!(whole > 0)) return std::nullopt;
  return 100 * part / whole;
}

// Lengths and recall of the truth, for every kind.
std::array<TrueKind, kNumKinds> MeasureTruth(const Comparison& c,
                                             double sample_mm) {
  std::array<TrueKind, kNumKinds> kinds;
  std::array<double, kNumKinds> found_mm = {};
  for (std::size_t i = 0; i < c.truth.size(); ++i) {
    const std::size_t kind = Index(c.truth[i].kind);
    kinds[kind].length_mm += sample_mm;
    if (!c.visible[i]) continue;
    kinds[kind].visible_length_mm += sample_mm;
    if (c.true_mm[i] < kNearMm) found_mm[kind] += sample_mm;
  }
  for (std::size_t i = 0; i < kNumKinds; ++i) {
    kinds[i].kind = static_cast<CurveKind>(i);
    kinds[i].visible_recall_5 =
        Percent(found_mm[i], kinds[i].visible_length_mm);
  }
  return kinds;
}

}  // namespace

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
  double all_mm = 0;
  double right_mm = 0;
  for (TrueKind& kind : kinds) {
    if (kind.length_mm == 0) continue;
    if (kind.kind != CurveKind::kUnknown) {
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

}  // namespace curvix
