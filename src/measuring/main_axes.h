// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// Up and two horizontals: the three perpendicular directions that most lines
// share, and axes of arcs and rows of holes, as those of houses, rooms and
// machined parts.
#pragma once

#include <curvix/fitting.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <array>
#include <vector>

#include "measuring/world_alignment.h"

namespace curvix {

struct MainAxes {
  // x: to the right of the cameras' mean view or, if they look all ways, along
  // most lines; z: up.
  KnownAxes axes;
  // Of x, y, z:
  std::array<int, 3> num_directions = {};  // that share it
  // Angles between the mean directions of those of (y, z), (z, x), (x, y),
  // each fitted by itself, and their standard deviations: how near to 90
  // degrees they come tells how good the axes are. NaN: no line in one of the
  // two.
  std::array<double, 3> angle_deg = {};
  std::array<double, 3> angle_sigma_deg = {};
};

// Of DirectionsOf(fitted). Candidates are pairs of perpendicular ones, of the
// 150 longest; the pair wins along whose three axes, to 1.5 degrees and the
// uncertainty of each direction, most length lies; ties go to the longer ones.
// Then least squares over these directions, weighted by their variances,
// down-weighted by Cauchy's loss. The covariance is that of least squares with
// the scatter that is left. Up is the axis nearest to `up`, a direction of the
// model. `views_direction`: mean direction in which cameras look, of length 1
// if all look the same way. kUnsupported: no two directions are perpendicular.
Result<MainAxes> FindMainAxes(const FittedCurves& fitted,
                              const Eigen::Vector3d& up,
                              const Eigen::Vector3d& views_direction);

// The mean of the up vectors (-y) of the cameras, and of the directions in
// which they look (z), in the frame of the scene.
Eigen::Vector3d MeanUp(const std::vector<View>& views);
Eigen::Vector3d MeanViewDirection(const std::vector<View>& views);

}  // namespace curvix
