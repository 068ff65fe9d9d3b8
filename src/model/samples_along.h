// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Samples at equal distances along a curve.
#pragma once

#include <curvix/curves.h>
#include <cstddef>
#include <limits>
#include <vector>

namespace curvix {

// Indices of samples `spacing` or more apart along the curve, at most
// `max_num`, the outer ones half as far from the ends; the middle one of a
// short curve. Ascending, without repeats. `spacing`: world units, > 0. The
// curve has samples.
std::vector<std::size_t> SamplesAlong(
    const Curve& curve,
    double spacing,
    std::size_t max_num = std::numeric_limits<std::size_t>::max());

}  // namespace curvix
