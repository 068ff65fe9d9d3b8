// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves and truth as samples, nearest to nearest.
#pragma once

#include <cstddef>
#include <vector>

#include "evaluation/resample_curves.h"
#include "synthetic/synthetic_scene.h"

namespace curvix {

inline constexpr double kNearMm = 5;  // what counts as the same place

// Both sets, and distances between them.
struct Comparison {
  std::vector<CurveStep> predicted;
  std::vector<TrueSample> truth;
  std::vector<bool> visible;           // per true sample
  std::vector<double> predicted_mm;    // distances predicted -> true
  std::vector<double> true_mm;         // distances true -> predicted
  std::vector<std::size_t> true_idxs;  // the nearest, per predicted sample
  double near = 0;                     // kNearMm in world units
  double unit_mm = 0;
};

}  // namespace curvix
