// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The most probable kind of a place on a curve.
#pragma once

#include <curvix/curves.h>

#include <array>
#include <cstddef>
#include <vector>

#include "curve_kinds/strips.h"

namespace curvix {

// The evidence at one place, or at several together, for each of kDepthsPx.
using DepthEvidence = std::array<SurfaceEvidence, kNumDepths>;

// The weighted sum over the places `around`, indices of `evidence`. Those that
// do not see a direction count as the mean of those that do, unless they are
// most.
DepthEvidence SumOver(const std::vector<std::size_t>& around,
                      const std::vector<DepthEvidence>& evidence);

struct KindProbability {
  CurveKind kind = CurveKind::kUnknown;
  double probability = 0;
};

// The most probable kind; kUnknown where fewer than three views face any
// surface that begins at the curve. A flat step is a crease.
KindProbability JudgeKind(const DepthEvidence& evidence);

// The directions of the surfaces on both sides, if it is one of the likeliest
// markings. A step that looks like a marking has these, too.
DirectionSet DirectionsOfMarkings(const SurfaceEvidence& evidence);

}  // namespace curvix
