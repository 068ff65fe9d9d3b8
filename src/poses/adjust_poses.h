// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Joint adjustment of poses, cameras, samples of
// curves and points.
//
// An edge does not determine the position along it. So a sample has three
// unknowns: two offsets across its tangent, and its radius
// (geometry/adjust_edge.h). Each edge gives one equation in these, the
// six unknowns of the view's pose and those of its camera. A point has three
// unknowns, and each view that sees it gives two equations.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/adjust_edge.h"
#include "geometry/edge_geometry.h"

namespace curvix {

// A sample of a curve and its edges in the views.
struct PoseSample {
  struct Observation {
    std::int32_t view_idx = 0;
    ImageEdge edge;  // in pixels of the photograph
  };
  OccludingContour contour;
  std::vector<Observation> observations;  // at most one per view
};

// A point and its pixels in the views.
struct PointSample {
  struct Observation {
    std::int32_t view_idx = 0;
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // of the photograph
  };
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  std::vector<Observation> observations;               // at most one per view
};

// The poses and cameras of a scene after a change.
struct MovedCameras {
  std::vector<Rigid3> new_cam_from_cam;  // by view, from the pose of the scene
  std::vector<Camera> cameras;           // by camera, instead of the scene's
};

struct PoseProblem {
  // The input. A prior pulls each pose to its input pose, with a standard
  // deviation of prior_px in the image. It fixes what observations leave free,
  // as the gauge. The points of the scene are not read.
  const Scene& scene;
  const std::vector<PoseSample>& samples;
  const std::vector<PointSample>& points;
  // By view: standard deviation of the distances from edges. Pixels, > 0.
  const std::vector<double>& sigmas_px;
  double point_sigma_px = 1;  // of a pixel of a point, in x and in y
  double prior_px = 10;
  // By camera: whether its first eight parameters are unknowns. Empty: none
  // are.
  std::vector<bool> free_lenses = {};
};

struct AdjustedPoses {
  // Views and cameras without observations stay as at the start.
  MovedCameras moved;
  std::vector<OccludingContour> contours;  // of the samples
  std::vector<Eigen::Vector3d> points;     // positions
  // The loss of each sample, then of each point, over its observations;
  // infinite if it is behind a camera.
  std::vector<double> costs;
};

// Minimises the distances of projected samples from the lines of their edges,
// and of projected points from their pixels, each over its sigma and with
// Cauchy's loss. Levenberg-Marquardt from `start` until a step lowers the
// cost by a share of less than 0.003; samples and points are eliminated. The
// result does not depend on the number of threads. The search ends when
// `keep_going`, called between iterations, returns false. Samples and points
// that are behind a camera at the start are left out.
AdjustedPoses AdjustPoses(const PoseProblem& problem,
                          const MovedCameras& start,
                          int num_threads,
                          const std::function<bool()>& keep_going);

}  // namespace curvix
