// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Poses and places on curves, adjusted together.
//
// An edge in an image says nothing about the place along it. So a sample moves
// only across its tangent, and its radius changes (geometry/rim.h); each of its
// edges gives one equation between these three unknowns and the six of the
// view's pose.
#pragma once

#include <curvix/scene.h>

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/edge_geometry.h"
#include "geometry/rim.h"
#include "model/posed_view.h"

namespace curvix {

// A place on a curve and where views see the curve there.
struct PoseSample {
  struct Observation {
    std::int32_t view_idx = 0;
    ImageEdge edge;
  };
  Rim rim;
  std::vector<Observation> observations;  // at most one per view
};

struct PoseProblem {
  // As they were in the beginning: a prior holds each pose there, with a
  // standard deviation of prior_px of shift in its image. It fixes the world
  // where edges do not.
  const std::vector<PosedView>& views;
  // By view: the standard deviation of distances from edges. Pixels, > 0.
  const std::vector<double>& sigmas_px;
  const std::vector<PoseSample>& samples;
  double prior_px = 10;
};

struct AdjustedPoses {
  // Of each view, from its camera in the beginning to its camera now; as it was
  // at the start for views without observations.
  std::vector<Rigid3> new_cam_from_cam;
  std::vector<Rim> rims;  // of the samples
};

// Minimises the distances between projected samples and the lines of their
// edges over sigma, with Cauchy's loss, by Levenberg and Marquardt with the
// samples eliminated. `start`, one motion per view as in AdjustedPoses, is
// where the search begins. The same result for any number of threads. Asked
// between iterations, `keep_going` stops early. Everything stays where it was
// if a sample is behind a camera.
AdjustedPoses AdjustPoses(const PoseProblem& problem,
                          const std::vector<Rigid3>& start,
                          int num_threads,
                          const std::function<bool()>& keep_going);

}  // namespace curvix
