// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The points in which primitives meet.
#pragma once

#include <curvix/fitting.h>

#include <vector>

#include "fitting/end_covariance.h"
#include "fitting/primitive.h"

namespace curvix {

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
