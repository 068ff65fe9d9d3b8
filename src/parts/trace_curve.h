// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves with the 2D edges behind them.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/parts.h>

#include <vector>

namespace curvix {

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
