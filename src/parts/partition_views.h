// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Divides views by the places that they see.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "parts/scene_parts.h"

namespace curvix {

// A partition as PartitionScene describes it. `places` of each view, at least
// one. nullopt: impossible with so few views in a part.
std::optional<ScenePartition> PartitionViews(
    const std::vector<std::vector<Eigen::Vector3d>>& places,
    double overlap,
    int max_views_per_part);

}  // namespace curvix
