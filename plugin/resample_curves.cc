// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "plugin/resample_curves.h"

#include <cmath>

namespace curvix {
namespace {

double TotalLength(const CurveSet& curves) {
  double total = 0;
  for (const Curve& curve : curves.curves) total += Length(curve);
  return total;
}

}  // namespace

double CountSteps(const CurveSet& curves, double step) {
  return TotalLength(curves) / step;
}

std::vector<CurveStep> Resample(const CurveSet& curves, double step) {
  std::vector<CurveStep> steps;
  double start = 0;  // arc length at the start of the segment
  for (std::size_t c = 0; c < curves.curves.size(); ++c) {
    const std::vector<CurveSample>& samples = curves.curves[c].samples;
    const std::size_t n = samples.size();
    const std::size_t num_segments =
        n < 2 ? 0 : (curves.curves[c].closed ? n : n - 1);
    for (std::size_t i = 0; i < num_segments; ++i) {
      const Eigen::Vector3d& from = samples[i].position;
      const Eigen::Vector3d along = samples[(i + 1) % n].position - from;
      const double length = along.norm();
      // Steps lie at (k + 1/2) step for k = steps.size().
      for (;;) {
        const double s = (static_cast<double>(steps.size()) + 0.5) * step;
        if (!(length > 0) || s >= start + length) break;
        const double t = (s - start) / length;
        steps.push_back({from + t * along, along / length, c});
      }
      start += length;
    }
  }
  return steps;
}

}  // namespace curvix
