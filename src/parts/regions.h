// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The regions of a partition, and runs of samples in
// them.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "parts/scene_parts.h"

namespace curvix {

// A cut as the core on one side of it sees it.
struct Border {
  Eigen::Vector3d normal;  // unit
  double offset = 0;
  bool is_above = false;  // the core is
};

// The borders of each part's core, which is convex.
std::vector<std::vector<Border>> CoresOf(const ScenePartition& partition);

// How far `position` is beyond the border of the core that is exceeded most:
// negative inside it, minus infinity without borders. World units.
double DistanceBeyond(const std::vector<Border>& core,
                      const Eigen::Vector3d& position);

// The runs of two samples or more that are at most `overlap` beyond the core,
// in the order of the curves; whole curves stay as they are, others lose their
// junctions.
std::vector<Curve> CutCurves(const std::vector<Curve>& curves,
                             const std::vector<Border>& core,
                             double overlap);

// The curve with the edges that it names: those of its samples, in order.
TracedCurve TraceCurve(Curve curve, const std::vector<EdgeMap>& edge_maps);

// Calls f(ref) for all support of the curve, in order.
template <typename F>
void ForEachSupport(Curve& curve, const F& f) {
  for (CurveSample& sample : curve.samples) {
    for (EdgeRef& ref : sample.support) f(ref);
  }
}

}  // namespace curvix
