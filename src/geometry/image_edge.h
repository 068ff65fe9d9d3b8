// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Detected edges as geometry.
#pragma once

#include <curvix/edges.h>

#include <cmath>

#include "geometry/edge_geometry.h"

namespace curvix {

inline ImageEdge ToImageEdge(const Edge2d& edge) {
  const double angle = static_cast<double>(edge.angle);
  return {edge.position, {std::cos(angle), std::sin(angle)}};
}

}  // namespace curvix
