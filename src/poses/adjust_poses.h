// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Poses, lenses, places on curves and points, adjusted
// together.
//
// An edge in an image says nothing about the place along it. So a sample moves
// only across its tangent, and its radius changes
// (geometry/occluding_contour.h); each of its edges gives one equation between
// these three unknowns, the six of the view's pose and those of its camera. A
// point has three unknowns, too, and each view that sees it gives two
// equations.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/edge_geometry.h"
#include "geometry/occluding_contour.h"

namespace curvix {

// A place on a curve and where views see the curve there.
struct PoseSample {
  struct Observation {
    std::int32_t view_idx = 0;
    ImageEdge edge;  // in pixels of the photograph
  };
  OccludingContour contour;
  std::vector<Observation> observations;  // at most one per view
};

// A point and where views see it.
struct PointSample {
  struct Observation {
    std::int32_t view_idx = 0;
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // of the photograph
  };
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  std::vector<Observation> observations;               // at most one per view
};

// What changes of the views of a scene.
struct MovedCameras {
  std::vector<Rigid3> new_cam_from_cam;  // by view, from the pose of the scene
  std::vector<Camera> cameras;           // by camera, instead of the scene's
};

struct PoseProblem {
  // As it was in the beginning: a prior holds each pose there, with a
  // standard deviation of prior_px of shift in its image. It fixes the world
  // where observations do not. Its points are not read.
  const Scene& scene;
  const std::vector<PoseSample>& samples;
  const std::vector<PointSample>& points;
  // By view: the standard deviation of distances from edges. Pixels, > 0.
  const std::vector<double>& sigmas_px;
  double point_sigma_px = 1;  // of a pixel of a point, in x and in y
  double prior_px = 10;
  // By camera: whether its first eight parameters change, too. Empty: of none.
  std::vector<bool> free_lenses = {};
  // Of the cost: the search ends with a step that gains a smaller share.
  double min_gain = 1e-4;
};

struct AdjustedPoses {
  // Views and cameras without observations are as they were at the start.
  MovedCameras moved;
  std::vector<OccludingContour> contours;  // of the samples
  std::vector<Eigen::Vector3d> points;     // positions
  // The loss of each sample, then of each point, over its observations.
  std::vector<double> costs;
};

// Minimises the distances between projected samples and the lines of their
// edges, and between points and their pixels, over sigma, with Cauchy's loss,
// by Levenberg and Marquardt with samples and points eliminated. The search
// begins at `start`. The same result for any number of threads. Asked between
// iterations, `keep_going` stops early. Everything stays where it was if a
// sample or a point is behind a camera.
AdjustedPoses AdjustPoses(const PoseProblem& problem,
                          const MovedCameras& start,
                          int num_threads,
                          const std::function<bool()>& keep_going);

}  // namespace curvix
