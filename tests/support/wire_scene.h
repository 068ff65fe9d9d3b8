// SPDX-License-Identifier: BSD-3-Clause
// A scene of thin curves with exact edges, and how well curves agree with it.
#pragma once

#include <curvix/curves.h>
#include <curvix/reconstruct.h>

#include <vector>

#include "tests/support/synthetic_edges.h"

namespace curvix {

// Posed edges and the curves that they show.
struct WireScene {
  Scene scene;
  std::vector<EdgeMap> edge_maps;
  std::vector<TestCurve> truth;
};

// `num_views` cameras of 400 x 400 pixels, about 6 from the origin, all around
// at irregular places above and below, looking at it. Curves hide nothing.
WireScene MakeWireScene(std::vector<TestCurve> truth, int num_views);

// About one pixel at the origin in these views.
inline constexpr double kWirePx = 1.0 / 65;

// A cube of side 2 around the origin and a circle of radius 0.6 inside it.
std::vector<TestCurve> CubeAndCircle();

struct WireAgreement {
  double worst_distance = 0;  // of a sample from the nearest true curve
  double accurate = 0;        // share of the samples within a tolerance of it
  double found = 0;         // share of the truth within a tolerance of a curve
  double length_ratio = 0;  // length of the curves over that of the truth
};

// Both shares for the same `tolerance`, a distance.
WireAgreement Compare(const CurveSet& curves,
                      const std::vector<TestCurve>& truth,
                      double tolerance);

// Distance of x from the nearest segment of the curves; infinite without any.
double DistanceToCurves(const CurveSet& curves, const Eigen::Vector3d& x);

}  // namespace curvix
