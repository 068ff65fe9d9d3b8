// SPDX-License-Identifier: BSD-3-Clause
// Straight lines of a ground truth.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "evaluation/ground_truth.h"

namespace curvix {

inline constexpr double kStep = 0.002;

// A segment as samples in the middle of each step, seen by `num_views`.
inline void AddTrueLine(const Eigen::Vector3d& from,
                        const Eigen::Vector3d& to,
                        int curve_id,
                        int num_views,
                        GroundTruth& truth,
                        CurveKind kind = CurveKind::kUnknown) {
  const double length = (to - from).norm();
  const Eigen::Vector3d tangent = (to - from) / length;
  const int n = static_cast<int>(std::lround(length / kStep));
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d position = from + (i + 0.5) * kStep * tangent;
    truth.samples.push_back(
        {position, tangent, curve_id, num_views, num_views, kind});
  }
}

}  // namespace curvix
