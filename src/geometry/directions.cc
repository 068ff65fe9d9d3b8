// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/directions.h"

#include <Eigen/Dense>

namespace curvix {

Eigen::Quaterniond ShortestRotation(const Eigen::Vector3d& from,
                                    const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

}  // namespace curvix
