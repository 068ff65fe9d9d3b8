// SPDX-License-Identifier: BSD-3-Clause
// What steps of a scene in parts read of its model.
#pragma once

#include <curvix/scene.h>
#include <vector>

#include "colmap/colmap_model.h"

namespace curvix {

// For a part: the images of these views with the points that they see.
ColmapModel ModelForPart(const ColmapModel& model,
                         const Scene& scene,
                         const std::vector<int>& view_idxs);

// For a merge: the images of all views, and of the points as many as
// viewer.html shows, kMaxViewerPoints at most, evenly by number.
ColmapModel ModelForMerge(const ColmapModel& model, const Scene& scene);

}  // namespace curvix
