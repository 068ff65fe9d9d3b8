// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The observations of AdjustPoses, as equations.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/lens.h"
#include "poses/adjust_poses.h"
#include "poses/solve_steps.h"

namespace curvix {

// The distance of a projected sample or point from `pixel`, along `direction`.
struct PoseObservation {
  Eigen::Vector3d position;   // in the camera with its input pose
  Eigen::Matrix3d moves;      // Jacobian of position by the sample's unknowns
  Eigen::Vector2d direction;  // over sigma
  Eigen::Vector2d pixel;
  std::size_t camera_idx;
};

// One for each edge of a sample, then two for each pixel of a point.
std::vector<PoseObservation> ObservationsOf(const PoseProblem& problem);

// View and sample of each; indices of points follow those of samples.
EquationOwners OwnersOf(const PoseProblem& problem);

// A camera during the search, and the derivatives of its pixels.
class CameraState {
 public:
  // Derivatives() needs `has_derivatives`.
  CameraState(const Lens& lens, const LensChange& change, bool has_derivatives);

  const Camera& camera() const { return camera_; }

  // Derivatives of direction . pixel by the parameters of the lens.
  LensChange Derivatives(const Eigen::Vector2d& direction,
                         const Eigen::Vector2d& ideal) const;

 private:
  Camera camera_;
  std::vector<Camera> around_;  // each parameter decreased, then increased
};

}  // namespace curvix
