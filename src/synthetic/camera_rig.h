// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Cameras around a solid at the origin.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "synthetic/synthetic_scene.h"

namespace curvix {

// The camera of all views: principal point in the middle, focal length 1.3
// times the shorter side. kInvalidArgument if options.distortion does not suit
// options.camera_model.
Result<Camera> MakeCamera(const SyntheticOptions& options);

// cam_from_world at `centre`, upright but for `roll` (radians) about the axis
// through `target`.
Rigid3 LookingAt(const Eigen::Vector3d& centre,
                 const Eigen::Vector3d& target,
                 double roll = 0);

// cam_from_world of `num_views` views that look at the origin, spread evenly
// over the elevations from -30 to 70 degrees, rolled by up to 20 degrees; a
// ball of `radius` fills 85 to 98 % of the image's shorter side.
std::vector<Rigid3> MakePoses(int num_views, double radius, std::uint64_t seed);

// `cam_from_world` turned and shifted in a random way (given by `seed`) by
// which the projections of those `points` that the image holds move by rms_px,
// root mean square; unchanged if it holds none.
Rigid3 Disturbed(const Rigid3& cam_from_world,
                 const Camera& camera,
                 const std::vector<Eigen::Vector3d>& points,
                 double rms_px,
                 std::uint64_t seed);

}  // namespace curvix
