// SPDX-License-Identifier: BSD-3-Clause
// What of a COLMAP model bundle adjustment can use, as a scene.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <cstddef>
#include <functional>

#include "colmap/colmap_model.h"

namespace curvix {

// Views with fewer observations than this are not adjusted: six numbers of a
// pose ask for more than the three points that can give them.
inline constexpr std::size_t kMinObservationsPerView = 12;

// The scene of `model`, without images: observations that are finite and in
// front of their camera, points with at least two of them, and the views that
// see at least kMinObservationsPerView of these points.
Scene AdjustableScene(const ColmapModel& model);

// Leaves out the observations of `point` at whose index `keep` is false.
void KeepObservations(const std::function<bool(std::size_t)>& keep,
                      ScenePoint* point);

// `model` with the cameras, poses and points of `scene`, which was made of it,
// and the points' mean errors; what is not in `scene` stays.
ColmapModel ModelWithScene(ColmapModel model, const Scene& scene);

// The position that fits the observations best under the scene's poses.
Eigen::Vector3d FitPoint(const Scene& scene, const ScenePoint& point);

// The same of every point.
void FitPoints(Scene* scene);

}  // namespace curvix
