// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Places on edges or on occluding contours of smooth
// bodies.
//
// Near its contour, a smooth body is nearly a cylinder. Each view sees the line
// of it that its ray touches; the radius is assumed to be small compared with
// the distance. An edge is a cylinder of radius zero. So one more unknown, the
// radius, covers both cases without a decision between them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/adjust_edge.h"
#include "geometry/edge_geometry.h"

namespace curvix {

struct OccludingContour {
  SpaceEdge axis;
  double radius = 0;  // world units; negative on the side against `outward`
  // On which side views see the body end; unit, across the axis. Of an edge, it
  // is any.
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
};

// A place of the contour amid those that views see.
Eigen::Vector3d MiddleOf(const OccludingContour& contour);

// The mean of the sides on which cameras at `centers` see the body end, up to
// sign: unit, across the axis.
Eigen::Vector3d MeanSide(const SpaceEdge& axis,
                         const std::vector<Eigen::Vector3d>& centers);

// From the axis to the place of the contour that a camera at `center` sees, for
// a radius of 1: a unit vector across the axis and the ray; zero where the ray
// runs along the axis.
Eigen::Vector3d SideSeenFrom(const OccludingContour& contour,
                             const Eigen::Vector3d& center);

SpaceEdge SeenFrom(const OccludingContour& contour,
                   const Eigen::Vector3d& center);

// Fits axis and radius to what at least two views measure, as AdjustEdge()
// does, from `start`. A very weak prior pulls towards radius 0 if the rays tell
// nothing of it.
OccludingContour AdjustOccludingContour(
    const OccludingContour& start,
    const std::vector<PlaneMeasurement>& measurements,
    double sigma_px);

}  // namespace curvix
