// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <curvix/curves.h>
#include <Eigen/Core>
#include <vector>

#include "synthetic/synthetic_scene.h"

namespace curvix {

// A point of a curve.
struct CurveStep {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  // of its segment, unit
  std::size_t curve_idx = 0;
  CurveKind kind = CurveKind::kUnknown;  // of the nearer sample
};

// The number of samples that Resample takes.
double CountSteps(const CurveSet& curves, double step);

// Points every `step` along all polylines, the first after step / 2. The arc
// length runs on from one curve to the next, so that many short curves are
// neither over- nor under-sampled.
std::vector<CurveStep> Resample(const CurveSet& curves, double step);

// For each sample the smallest id of the chain of true curves that continue
// each other smoothly: an end of one within `max_gap` (world units) of an end
// of the other, directions within 15 degrees. Each end continues at most one
// other, the straightest first. So a circle that the truth has as two arcs
// counts as one curve.
std::vector<int> SmoothGroups(const std::vector<TrueSample>& truth,
                              double max_gap);

}  // namespace curvix
