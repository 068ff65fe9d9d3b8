// SPDX-License-Identifier: BSD-3-Clause
// Square markers of known size, found in the images: ArUco and AprilTag.
#pragma once

#include <curvix/options.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <string>
#include <vector>

#include "measuring/world_alignment.h"

namespace curvix {

struct FoundMarker {
  int id = 0;
  int num_views = 0;
  // The side of the square that fits the corners, model units.
  double side = 0;
  KnownScale scale;  // that this marker tells
  // The part of scale.sigma that all markers have in common.
  double common_sigma = 0;
};

struct FoundMarkers {
  std::vector<FoundMarker> markers;  // ascending by id
  double corner_sigma_px = 0;        // of a corner in an image
  std::vector<std::string> notes;    // of markers that were left out
};

// Finds the markers of a dictionary, and lines through the edges of their
// sides, triangulates their corners, and compares the squares with `size`, the
// side of the black square, world units. The standard deviation of corners in
// images is what the triangulation leaves; that of the scale also has what errs
// alike in all images and markers. Same result for any number of threads.
// kNotFound: an image cannot be read, or no marker is seen well by three views,
// as without OpenCV's aruco module.
Result<FoundMarkers> FindMarkers(const Scene& scene,
                                 const std::string& dictionary,
                                 double size,
                                 const RuntimeOptions& runtime);

}  // namespace curvix
