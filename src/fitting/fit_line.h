// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Straight lines.
#pragma once

#include <optional>

#include "fitting/fit_samples.h"

namespace curvix {

struct FittedLine {
  Eigen::Vector3d origin;     // on the line
  Eigen::Vector3d direction;  // unit, from the first sample to the last

  Eigen::Vector3d Closest(const Eigen::Vector3d& point) const {
    return origin + direction.dot(point - origin) * direction;
  }
};

// The line with the least robust sum of squared distances. nullopt: fewer than
// two samples, or all in one place.
std::optional<FittedLine> FitLine(const FitSamples& samples);

}  // namespace curvix
