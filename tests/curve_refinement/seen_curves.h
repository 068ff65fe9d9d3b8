// SPDX-License-Identifier: BSD-3-Clause
// Curves with views of them and the edges that support them.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "tests/curve_refinement/drawn_curves.h"

namespace curvix {

struct SeenCurves {
  std::vector<Curve> curves;
  std::vector<PosedView> views;
  std::vector<EdgeMap> edge_maps;
};

// A curve, views of it, and exact 2D edges of all its samples.
struct SeenCurve {
  Curve truth;
  std::vector<PosedView> views;
  std::vector<EdgeMap> edge_maps;
};

inline SeenCurve SeeFrom(std::vector<PosedView> views, Curve curve) {
  SeenCurve seen;
  seen.views = std::move(views);
  std::vector<Curve> curves = {std::move(curve)};
  seen.edge_maps = SupportByEdges(seen.views, curves);
  seen.truth = std::move(curves[0]);
  return seen;
}

// From the side of FrontalViews(), but from eight places on a wave.
inline std::vector<PosedView> EightViews() {
  std::vector<PosedView> views;
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.2 * i;
    views.push_back(LookAt({4 * std::sin(angle), -8, 1.5 * std::cos(2 * angle)},
                           {0, 0, 0}));
  }
  return views;
}

}  // namespace curvix
