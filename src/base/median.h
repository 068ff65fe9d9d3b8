// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "base/check.h"

namespace curvix {

// Standard deviation of a normal distribution, over the median of absolute
// values.
inline constexpr double kSigmasPerMedian = 1.4826;

// The value in the middle; of an even number, the larger of the two, so that it
// is one of the values (MedianOrNan takes their mean). `values` must not be
// empty or hold NaN.
inline double Median(std::vector<double> values) {
  CURVIX_CHECK(!values.empty(), "no value is in the middle of none");
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// As Median; `fallback` of none.
inline double MedianOr(double fallback, std::vector<double> values) {
  return values.empty() ? fallback : Median(std::move(values));
}

// As Median, of each coordinate; zero of none.
inline Eigen::Vector3d MedianPosition(
    const std::vector<Eigen::Vector3d>& positions) {
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& position : positions) values.push_back(position[axis]);
    median[axis] = MedianOr(0, std::move(values));
  }
  return median;
}

// Unlike Median, of an even number the mean of the two values in the middle;
// NaN of none. `values` must not hold NaN.
inline double MedianOrNan(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

}  // namespace curvix
