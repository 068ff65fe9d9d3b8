// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The observations of AdjustPoses in one form.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "poses/adjust_poses.h"

namespace curvix {

// Where a view sees a sample or a point.
struct PoseObservation {
  std::size_t view_idx;
  std::size_t camera_idx;
  std::size_t sample_idx;    // indices of points follow those of samples
  Eigen::Vector3d position;  // in the camera with its input pose
  Eigen::Matrix3d moves;     // Jacobian of position by the sample's unknowns
  Eigen::Vector2d pixel;
  // By row what is measured from `pixel`, over sigma: of a point x and y, of an
  // edge the distance across and nothing.
  Eigen::Matrix2d axes;
};

// One for each edge of a sample, then for each pixel of a point.
std::vector<PoseObservation> ObservationsOf(const PoseProblem& problem);

}  // namespace curvix
