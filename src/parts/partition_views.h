// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Divides views by the places that they see; the
// regions of the parts.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "parts/scene_parts.h"

namespace curvix {

// A partition as PartitionScene describes it. `places` of each view, at least
// one. nullopt: impossible with so few views in a part.
std::optional<ScenePartition> PartitionViews(
    const std::vector<std::vector<Eigen::Vector3d>>& places,
    double overlap,
    int max_views_per_part);

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

// Calls f(ref) for all support of the curve, in order.
template <typename F>
void ForEachSupport(Curve& curve, const F& f) {
  for (CurveSample& sample : curve.samples) {
    for (EdgeRef& ref : sample.support) f(ref);
  }
}

}  // namespace curvix
