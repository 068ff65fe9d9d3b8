// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Spread of the distances of edges from projections.
#pragma once

#include <vector>

namespace curvix {

// The standard deviation of the `distances_px` from the nearest edge, without
// those from other edges nearby. A mixture of a half-normal density, and for
// other edges a uniform one on [0, gate_px], is fitted by expectation
// maximisation from three starts, and the most likely result is taken. Narrow
// results with a small share are not: successive samples make narrow peaks by
// chance. At least 0.05. `distances_px` must not be empty.
double FitSpread(const std::vector<double>& distances_px, double gate_px);

}  // namespace curvix
