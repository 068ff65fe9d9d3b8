// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Predicted kinds of curves against true ones.
#pragma once

#include <curvix/curves.h>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "evaluation/comparison.h"

namespace curvix {

inline constexpr std::size_t kNumKinds = 5;  // of CurveKind

// Lengths by the kind that the curves are said to be, mm.
using LengthPerKind = std::array<double, kNumKinds>;

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
  // be of that kind; unknown is wrong.
  std::optional<double> right;
};

// `step` and `spacing`: the lengths that one predicted and one true sample
// stand for, world units.
KindAgreement MeasureKinds(const Comparison& comparison,
                           double step,
                           double spacing);

}  // namespace curvix
