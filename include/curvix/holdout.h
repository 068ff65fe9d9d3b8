// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How well curves agree with photographs that had no
// part in making them: a measure that needs no true curves.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <curvix/status.h>

#include <cstdint>
#include <vector>

namespace curvix {

struct HoldoutOptions {
  // Of the views in order, number `every`, 2 * every, ... are held out; >= 2.
  int every = 8;
  // A sample of a curve is on an edge if its projection is no further from the
  // edge's tangent line, and its direction differs by no more. > 0.
  double max_distance_px = 1;
  double max_angle_deg = 15;
  // How far projections are moved across the curve, to both sides, to find how
  // often chance puts them on an edge. Pixels, > 0.
  double shift_px = 10;
};

// Samples of curves, projected into held-out views.
struct HoldoutAgreement {
  std::int64_t num_projections = 0;
  double support = 0;  // share of them on an edge; 0..1
  double chance = 0;   // the same after they were moved; 0..1
  // Of those on an edge, from it. Pixels; 0 if there are none.
  double median_distance_px = 0;
};

struct Holdout {
  int num_held_out = 0;  // views
  // All projections into the images, also of what something hides there.
  HoldoutAgreement all;
  // Only those that should be seen: of the views used, the two in most like
  // direction from the sample support it.
  HoldoutAgreement expected;
  Reconstruction reconstruction;  // from the other views; support, too, refers
                                  // to the views as they are in the scene
};

// Reconstructs without the held-out views and measures in these. `edge_maps`:
// one per view of the scene. Fails as ReconstructCurves does, and with
// kInvalidArgument if an option is out of range, no view is held out, or fewer
// than three are left.
Result<Holdout> EvaluateHoldout(const Scene& scene,
                                const std::vector<EdgeMap>& edge_maps,
                                const Options& options,
                                const HoldoutOptions& holdout_options,
                                const Progress& progress = {});

}  // namespace curvix
