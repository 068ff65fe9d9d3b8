// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What the search for poses estimates: the shift of an
// image, the spread of distances, and the gauge, that is the world frame and
// unit of the input poses.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "geometry/similarity.h"
#include "model/posed_view.h"

namespace curvix {

// The edges around one projected sample of a curve.
struct EdgesAround {
  // Across its projected tangent; unit.
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  // Signed distances of edges of like direction, along the normal. Pixels.
  std::vector<double> distances_px;
};

// The shift of the image, up to `reach_px` in x and in y, that brings most
// samples onto an edge. Wrong matches do no harm, since they share no shift.
// Zero unless another shift is clearly better. Pixels; ties: of whole steps,
// smaller y, then smaller x.
Eigen::Vector2d FindShift(const std::vector<EdgesAround>& samples,
                          double reach_px);

// The standard deviation of the `distances_px` from the nearest edge, without
// those from other edges nearby. A mixture of a half-normal density, and for
// other edges a uniform one on [0, gate_px], is fitted by expectation
// maximisation from three starts, and the most likely result is taken. Narrow
// results with a small share are not: successive samples make narrow peaks by
// chance. At least 0.05. `distances_px` must not be empty.
double FitSpread(const std::vector<double>& distances_px, double gate_px);

// The pixel at which a view with its new pose sees a place of the new world.
struct SeenPlace {
  std::size_t view_idx = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // new world
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// old_world_from_new_world: the similarity after which `views`, with their old
// poses, project the places nearest to their pixels by the new poses. Camera
// centres would determine it poorly: they depend on the focal length, and
// rotations and translations of a camera can compensate each other in its
// image. Gauss-Newton with Cauchy's weights, scaled by the median distance; the
// identity without places.
Similarity3 FixGauge(const std::vector<PosedView>& views,
                     const std::vector<SeenPlace>& places);

}  // namespace curvix
