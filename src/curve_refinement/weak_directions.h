// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). In which direction across it images hardly determine
// a curve: that of the depth, if the curve lies along the baseline.
#pragma once

#include <curvix/curves.h>
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace curvix {

struct WeakDirection {
  Eigen::Vector3d direction;  // unit, orthogonal to `along`
  Eigen::Vector3d along;      // unit, the mean tangent
  // Of the standard deviation of a place in `direction` to that across it.
  double ratio = 1;
};

// For each sample, the direction across the curve in which the samples up to
// six before and behind it are determined least. `information` has the inverse
// covariances of the places of samples in units of any scale, of rank 2 or
// less. nullopt where the ratio is less than two, and where the curve turns by
// more than 10 degrees across `direction`, since images show that it is not
// straight there. Needs six samples or more.
std::vector<std::optional<WeakDirection>> WeakDirections(
    const Curve& curve, const std::vector<Eigen::Matrix3d>& information);

}  // namespace curvix
