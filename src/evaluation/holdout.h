// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How well curves agree with images that had no
// part in making them: a measure that needs no true curves.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstddef>
#include <optional>
#include <vector>

namespace curvix {

// A share, and how large it is after everything was moved by 12 pixels across,
// to either side: 0..1.
struct ShareAboveChance {
  double share = 0;
  double chance = 0;

  // What is above chance, of what can be: (share - chance) / (1 - chance); 0 if
  // chance is 1.
  double Lift() const {
    return chance < 1 ? (share - chance) / (1 - chance) : 0;
  }
};

// Curves and images. What is in an image is found by Canny's edges and
// LSD's lines, not by the edges that curves are made of. Hidden curves are not
// left out.
struct ImageAgreement {
  // Of the steps of 2 pixels that the projected curves take, each segment at
  // least one, those that lie on a contour: within 1.5 pixels and 15 degrees.
  ShareAboveChance precision;
  // The same of those samples only that should be seen: of the other views, the
  // two in most like direction support it. nullopt: there are none.
  std::optional<ShareAboveChance> expected_precision;
  // Of the strongest fifth of all contours, what lies within 2 pixels and 15
  // degrees of a curve.
  ShareAboveChance strong_contours;
  // Of the length of straight lines that are 2 % of the image's diagonal and
  // longer, what lies within 3 pixels and 10 degrees of a curve.
  ShareAboveChance long_lines;
  // Median length of a curve in an image. Pixels; 0 if there is none.
  double median_piece_px = 0;
};

// Compares curves of any origin with the images of `view_idxs`, by their
// image files. Fails if an image cannot be read.
Result<ImageAgreement> CompareWithImages(const std::vector<Curve>& curves,
                                         const Scene& scene,
                                         const std::vector<int>& view_idxs,
                                         int num_threads);

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
