// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Points that contradict the poses.
#pragma once

#include <curvix/scene.h>
#include <filesystem>
#include <string>
#include <vector>

namespace curvix {

// Distances in pixels from observed to projected, where the pixel is known;
// infinite where nothing is projected.
std::vector<double> ReprojectionErrors(const Scene& scene,
                                       const ScenePoint& point);

// Removes the points of `scene`, read from `model_path`, if they project more
// than 50 px from their pixels (median; behind the camera is infinitely far):
// they were moved or scaled without the poses. Returns a sentence for the user,
// "" if they stay.
std::string RemoveInconsistentPoints(const std::filesystem::path& model_path,
                                     Scene* scene);

// A sentence for the user if the points of `scene` project more than 2 px from
// their pixels (median), as with a wrong focal length; "" if they do not, or
// have fewer than 100 pixels in all.
std::string LargeErrorsNote(const Scene& scene);

}  // namespace curvix
