// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6. Curves strung together, and cut.
#pragma once

#include <curvix/curves.h>

#include <cstddef>
#include <functional>
#include <vector>

#include "model/end_chains.h"

namespace curvix {

// `curve` run through from its end; tangents turn with it.
Curve Reversed(Curve curve);

// Samples between the last sample of one curve and the first of the next.
using FillGap = std::function<std::vector<CurveSample>(const CurveSample& from,
                                                       const CurveSample& to)>;

// One curve per chain of ties between ends (end_chains.h; items are `curves`),
// in the order of FollowEnds. `fill` (may be empty) is asked for the samples of
// each gap, that of a closed chain included.
std::vector<Curve> StringTogether(std::vector<Curve> curves,
                                  const EndTies& ties,
                                  const FillGap& fill);

// The pieces of `curve` that end with the samples of these indices, ascending;
// a closed one is opened behind the first of them. Without any, the curve.
std::vector<Curve> CutAfter(const Curve& curve,
                            const std::vector<std::size_t>& samples);

// As CutAfter, but the next piece begins with the same sample, too.
std::vector<Curve> CutAt(const Curve& curve,
                         const std::vector<std::size_t>& samples);

}  // namespace curvix
