// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). A point from its pixels.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <vector>

namespace curvix {

// A point in an image.
struct PointInImage {
  const Camera* camera = nullptr;  // not null
  Rigid3 cam_from_world;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// The position whose projections fit best, with Cauchy's loss of scale 1 px:
// Gauss-Newton steps from `start`, as long as they help; `start` where none
// does.
Eigen::Vector3d FitPoint(const Eigen::Vector3d& start,
                         const std::vector<PointInImage>& seen);

// Poses are good enough if points or edges are this far off (median, pixels).
// Edges of exact poses are half as far off; poses that are a quarter of a pixel
// off make it twice as much.
inline constexpr double kGoodPoseErrorPx = 0.06;

// Whether poses are good enough, by the reprojection errors of points (pixels)
// in each view: if the medians of all views are small, the points contradict
// any other poses. A view without points is not good enough.
bool PointsFit(std::vector<std::vector<double>> errors_by_view);

}  // namespace curvix
