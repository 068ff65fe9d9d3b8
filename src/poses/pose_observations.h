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
  Eigen::Vector3d position;   // in the camera as it was in the beginning
  Eigen::Matrix3d moves;      // of the position, by the unknowns of the sample
  Eigen::Vector2d direction;  // over sigma
  Eigen::Vector2d pixel;
  std::size_t camera_idx;
};

// One of each edge of a sample, then two of each pixel of a point.
std::vector<PoseObservation> ObservationsOf(const PoseProblem& problem);

// Whose they are; points count on from samples.
EquationOwners OwnersOf(const PoseProblem& problem);

// A camera at a step of the search, and how its pixels change with it.
class CameraState {
 public:
  // Only with `has_derivatives`, Derivatives() may be asked.
  CameraState(const Lens& lens, const LensChange& change, bool has_derivatives);

  const Camera& camera() const { return camera_; }

  // Of `direction` . pixel, by the changes of the lens.
  LensChange Derivatives(const Eigen::Vector2d& direction,
                         const Eigen::Vector2d& ideal) const;

 private:
  Camera camera_;
  std::vector<Camera> around_;  // each parameter less, then more
};

}  // namespace curvix
