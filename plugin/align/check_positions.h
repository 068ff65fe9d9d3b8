// SPDX-License-Identifier: BSD-3-Clause
// Whether the positions that a user gives are those of the cameras.
#pragma once

#include <curvix/status.h>
#include <Eigen/Core>
#include <cstddef>

#include "measuring/world_alignment.h"

namespace curvix {

// Of the positions, one or more: by how much they are off, root mean square,
// world units; and the index of the one that is furthest off.
double RmsOf(const AlignmentResult& result);
std::size_t WorstOf(const AlignmentResult& result);

// Whether the positions turn the cameras on their heads, in a world whose z is
// up. `up_of_cameras`: MeanUp(), model.
bool AreUpsideDown(const AlignmentResult& result,
                   const Eigen::Vector3d& up_of_cameras);

// kInvalidArgument, with a sentence that says what to look for: the positions
// are far off, fit better in a mirror, or, if `z_is_up`, turn the cameras on
// their heads. Without positions, all is well.
Status CheckPositions(const AlignmentInput& input,
                      const AlignmentResult& result,
                      const Eigen::Vector3d& up_of_cameras,
                      bool z_is_up);

}  // namespace curvix
