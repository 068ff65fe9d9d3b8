// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). How well primitives are known, and the points in
// which they meet.
#pragma once

#include <curvix/fitting.h>
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fitting/primitive.h"
#include "geometry/edge_geometry.h"

namespace curvix {

// The foot of `point` on a line or conic, and the direction there. nullopt: a
// spline, which takes its ends where the nodes are.
std::optional<SpaceEdge> FootOn(const Shape& shape,
                                const Eigen::Vector3d& point);

// Where a primitive ends, and how well its samples fix it there.
struct PrimitiveEnd {
  FitSample sample;         // the last one there
  Eigen::Vector3d foot;     // of the sample
  Eigen::Vector3d tangent;  // unit
  // Of the foot, without errors that all samples share. Across the tangent:
  // from the samples, of which one in 4 px is independent. Along it: 4 px,
  // which a corner bends edges.
  Eigen::Matrix3d covariance;  // positive definite; world units squared
  double common = 0;           // standard deviation of the shared errors
  bool fixes_node = false;     // it is of a line or conic
  int node = -1;               // index into the nodes; -1: the end is free
};

// At the first or the last sample.
PrimitiveEnd EndOf(const Shape& shape, const FitSamples& samples, bool at_end);

// The covariance of `position`, in which these ends (one or more) meet: that of
// their weighted mean, times the mean square by which they miss it in standard
// deviations, if that is larger than 1; and the shared errors. World units
// squared.
Eigen::Matrix3d MeetingCovariance(const std::vector<PrimitiveEnd>& ends,
                                  const Eigen::Vector3d& position);

struct UncertainPoint {
  Eigen::Vector3d position;
  Eigen::Matrix3d covariance;  // world units squared
};

// The covariance, as CurveFit::arc_covariance has it, of a circle that was
// fitted to `samples` by least squares and made to pass through `points`.
// Errors of the samples: their own, of which one in 4 px is independent and
// which are taken as larger if the samples lie further from the circle; and, of
// each sample's `common`, modes that all samples share: a constant, a slope
// and a bow, or a constant and a shift if the circle is whole, in the plane and
// off it.
Eigen::Matrix<double, 7, 7> ArcCovariance(
    const Conic& circle,
    const FitSamples& samples,
    const std::vector<UncertainPoint>& points,
    bool is_whole);

// A primitive of a curve and its ends.
struct PrimitiveOfCurve {
  Primitive primitive;
  PrimitiveEnd at_start;
  PrimitiveEnd at_end;
};

using CurvePrimitives = std::vector<PrimitiveOfCurve>;

// The nodes, as FitCurves describes them: by their first end. Sets the nodes of
// the ends.
std::vector<CurveNode> MeetInNodes(std::vector<CurvePrimitives>& curves);

}  // namespace curvix
