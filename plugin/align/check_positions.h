// SPDX-License-Identifier: BSD-3-Clause
// Whether the positions that a user gives are those of the cameras.
#pragma once

#include <curvix/status.h>
#include <Eigen/Core>
#include <cstddef>

#include "measuring/world_alignment.h"

namespace curvix {

// Above it, something that is given is wrong (AlignmentResult::misfit).
inline constexpr double kLargeMisfit = 3;

// Means over the cameras, in the frame of the model.
struct MeanDirections {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();       // MeanUp()
  Eigen::Vector3d forward = Eigen::Vector3d::Zero();  // MeanViewDirection()
};

// Of the positions, one or more: by how much they are off, root mean square,
// world units; and the index of the one that is furthest off.
double RmsOf(const AlignmentResult& result);
std::size_t WorstOf(const AlignmentResult& result);

// Whether positions turn the cameras upside down, or turn cameras that look
// down to the sky, in a world whose z is up.
bool AreUpsideDown(const AlignmentResult& result,
                   const MeanDirections& cameras);

// kInvalidArgument, with a sentence that says what to look for: the positions
// are far off, fit much better with x and y swapped, or, if `z_is_up`, turn the
// cameras upside down. Positions whose sigmas allow it may be far off. Without
// positions, all is well.
Status CheckPositions(const AlignmentInput& input,
                      const AlignmentResult& result,
                      const MeanDirections& cameras,
                      bool z_is_up);

}  // namespace curvix
