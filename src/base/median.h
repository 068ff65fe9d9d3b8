// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/check.h"

namespace curvix {

// The value in the middle; of an even number, the larger of both. `values` must
// not be empty or hold NaN.
inline double Median(std::vector<double> values) {
  CURVIX_CHECK(!values.empty(), "no value is in the middle of none");
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

inline double MedianOr(double fallback, std::vector<double> values) {
  return values.empty() ? fallback : Median(std::move(values));
}

}  // namespace curvix
