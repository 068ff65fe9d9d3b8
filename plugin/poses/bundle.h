// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment's unknowns and data: poses, cameras, points, and where the
// points are seen.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "colmap/colmap_model.h"

namespace curvix {

struct BundleView {
  std::size_t image_idx = 0;   // in the model
  std::size_t camera_idx = 0;  // in the model and in Bundle::cameras
  Rigid3 cam_from_world;
};

struct BundleObservation {
  std::size_t view_idx = 0;  // in Bundle::views
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

struct BundlePoint {
  std::size_t point_idx = 0;  // in the model
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<BundleObservation> observations;  // at least two views
};

struct Bundle {
  std::vector<Camera> cameras;  // all of the model
  std::vector<BundleView> views;
  std::vector<BundlePoint> points;
};

// Views with fewer observations than this are not part of a bundle: six numbers
// of a pose ask for more than the three points that can give them.
inline constexpr std::size_t kMinObservationsPerView = 12;

// What of `model` bundle adjustment can use, in the model's order: tracks whose
// images and 2D points exist, with every observation finite and in front of its
// camera, in at least two views; and the views that see at least
// kMinObservationsPerView of these points.
Bundle BundleFromModel(const ColmapModel& model);

// `model` with the cameras, poses and points of `bundle`, and the points' mean
// errors; what is not in `bundle` stays.
ColmapModel ModelWithBundle(ColmapModel model, const Bundle& bundle);

// Distances in pixels from observed to projected; infinite where nothing is
// projected.
std::vector<double> ReprojectionErrors(const Bundle& bundle,
                                       const BundlePoint& point);

// The position that fits the observations best under the bundle's poses.
Eigen::Vector3d FitPoint(const Bundle& bundle, const BundlePoint& point);

// The same of every point.
void FitPoints(Bundle* bundle);

}  // namespace curvix
