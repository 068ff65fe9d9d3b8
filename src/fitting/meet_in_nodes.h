// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The points in which primitives meet.
#pragma once

#include <curvix/fitting.h>

#include <optional>
#include <vector>

#include "fitting/primitive.h"

namespace curvix {

// The primitives of one curve and what they were chosen for.
struct CurvePrimitives {
  bool closed = false;
  FitSamples samples;
  std::vector<Primitive> primitives;
};

// The nodes, as FitCurves describes them: by their first end.
std::vector<CurveNode> MeetInNodes(const std::vector<CurvePrimitives>& curves);

// A point on a shape and the direction of the shape there.
struct Foot {
  Eigen::Vector3d position;
  Eigen::Vector3d tangent;  // unit
};

// The foot of `point` on a line or conic. nullopt: a spline, which takes its
// ends where the nodes are.
std::optional<Foot> FootOn(const Shape& shape, const Eigen::Vector3d& point);

}  // namespace curvix
