// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Samples of curves, found by where they are.
#pragma once

#include <curvix/curves.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "base/point_tree.h"

namespace curvix {

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
