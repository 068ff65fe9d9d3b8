// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The segments of a part's curves near its core.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <vector>

#include "parts/regions.h"
#include "parts/scene_parts.h"

namespace curvix {

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
