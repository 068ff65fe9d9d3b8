// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run_counts.h"

#include <cstdint>

#include "plugin/text.h"

namespace curvix {

StageCounts CountEdges(const std::vector<EdgeMap>& edge_maps) {
  std::int64_t num_edges = 0, num_masked = 0;
  std::int64_t num_isolated = 0, num_over_limit = 0;
  for (const EdgeMap& map : edge_maps) {
    num_edges += static_cast<std::int64_t>(map.edges.size());
    num_masked += map.num_dropped_masked;
    num_isolated += map.num_dropped_isolated;
    num_over_limit += map.num_dropped_over_limit;
  }
  StageCounts counts = {{"edges", num_edges}};
  if (num_masked > 0) counts.emplace_back("left out by masks", num_masked);
  if (num_isolated > 0) {
    counts.emplace_back("left out as noise", num_isolated);
  }
  if (num_over_limit > 0) {
    counts.emplace_back(
        "weak, short or crowded ones left out "
        "(EdgeDetection.max_edges_per_megapixel)",
        num_over_limit);
  }
  return counts;
}

std::string CountsText(const StageCounts& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    text += (text.empty() ? "" : ", ") + GroupDigits(count) + " " + name;
  }
  return text;
}

StageCounts CountFits(const FittedCurves& fitted) {
  std::int64_t lines = 0, arcs = 0, ellipses = 0, splines = 0;
  for (const FittedCurve& curve : fitted.curves) {
    for (const CurveFit& fit : curve.fits) {
      lines += fit.kind == FitKind::kLine;
      arcs += fit.kind == FitKind::kArc;
      ellipses += fit.kind == FitKind::kEllipse;
      splines += fit.kind == FitKind::kSpline;
    }
  }
  return {{"lines", lines},
          {"arcs", arcs},
          {"ellipses", ellipses},
          {"splines", splines},
          {"nodes", static_cast<std::int64_t>(fitted.nodes.size())}};
}

}  // namespace curvix
