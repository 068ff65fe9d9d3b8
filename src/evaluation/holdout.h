// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves without a part of the images, to hold against
// these (image_agreement.h).
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstddef>
#include <vector>

namespace curvix {

// The views that are held out if it is one of `every` (>= 2), from the middle
// of the first `every` on: of 8, numbers 4, 12, 20 and so on, from 0.
// kInvalidArgument: `every` is less than 2, or no view is held out.
Result<std::vector<int>> ViewsHeldOut(std::size_t num_views, int every);

struct Holdout {
  std::vector<int> view_idxs;     // held out
  Reconstruction reconstruction;  // from the other views; support, too, refers
                                  // to the views as they are in the scene
};

// Reconstructs without the views that ViewsHeldOut() names. `edge_maps`: one
// per view of the scene. Fails as ReconstructCurves does, with too few views
// left, say, and as ViewsHeldOut().
Result<Holdout> ReconstructWithHoldout(const Scene& scene,
                                       const std::vector<EdgeMap>& edge_maps,
                                       const Options& options,
                                       int every,
                                       const Progress& progress = {});

}  // namespace curvix
