// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Ranges of the samples of a curve.
#pragma once

#include <curvix/curves.h>
#include <cstddef>
#include <vector>

namespace curvix {

// Samples begin, ..., end - 1.
struct SampleRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// The longest ranges of true.
std::vector<SampleRange> RangesOf(const std::vector<bool>& kept);

// The samples of a range, which leave the curve empty behind. The whole curve
// stays what it is; a part of it is open and has no junctions.
Curve TakeOut(Curve& curve, const SampleRange& range);

// The ranges of so many samples or more that are kept, each a curve.
std::vector<Curve> KeepRanges(Curve curve,
                              std::vector<bool> kept,
                              std::size_t min_samples = 2);

}  // namespace curvix
