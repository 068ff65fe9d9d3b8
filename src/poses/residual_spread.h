// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How far edges lie from where poses put them.
#pragma once

#include <vector>

namespace curvix {

// The standard deviation of those of the `distances_px` from the nearest edge
// that belong to the projected curve. The others are from whatever lies around,
// and anywhere in [0, gate_px]: a half-normal and a uniform density, mixed and
// fitted by expectation maximisation. Of three starts the likeliest end counts;
// an end narrower than its start's would be counts only if it explains most of
// what it could by chance. At least 0.05. `distances_px` not empty.
double FitSpread(const std::vector<double>& distances_px, double gate_px);

}  // namespace curvix
