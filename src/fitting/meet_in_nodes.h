// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The points in which primitives meet.
#pragma once

#include <curvix/fitting.h>

#include <optional>
#include <vector>

#include "fitting/primitive.h"

namespace curvix {

// A primitive of a curve, and its first and last sample.
struct PrimitiveOfCurve {
  Primitive primitive;
  FitSample start;
  FitSample end;
};

using CurvePrimitives = std::vector<PrimitiveOfCurve>;

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
