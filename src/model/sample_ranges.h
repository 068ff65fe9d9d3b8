// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Some of the samples of curves: ranges of them,
// samples at equal distances, and those near a place.
#pragma once

#include <curvix/curves.h>
#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/point_tree.h"

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

// Indices of the first samples behind places at least `spacing` apart along the
// curve, at most `max_num`, the outer places half as far from the ends; the
// middle one of a short curve. Ascending, without repeats. `spacing`: world
// units, > 0. The curve has samples.
std::vector<std::size_t> SamplesAlong(
    const Curve& curve,
    double spacing,
    std::size_t max_num = std::numeric_limits<std::size_t>::max());

struct SamplePlace {
  std::size_t curve_idx = 0;
  std::size_t sample_idx = 0;
};

// All samples of some curves, numbered in the order of curves and samples.
class SampleTree {
 public:
  explicit SampleTree(const std::vector<Curve>& curves);

  const std::vector<SamplePlace>& Places() const { return places_; }

  // The numbers of the samples at most `radius` from `center`, ascending.
  std::vector<std::size_t> Within(const Eigen::Vector3d& center,
                                  double radius) const {
    return tree_.Within(center, radius);
  }

 private:
  std::vector<SamplePlace> places_;
  PointTree tree_;
};

}  // namespace curvix
