// SPDX-License-Identifier: BSD-3-Clause
// A few things that stand for all.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/infinity.h"

namespace curvix {

// Up to `count` of the things 0 to size - 1: the first, then always the one
// that is furthest from those chosen before, by `distance` of two; ties go to
// the smaller.
template <typename Distance>
std::vector<std::size_t> SpreadOut(std::size_t size,
                                   std::size_t count,
                                   const Distance& distance) {
  std::vector<double> farness(size, kInfinity);
  std::vector<std::size_t> chosen;
  while (chosen.size() < std::min(size, count)) {
    const auto next = static_cast<std::size_t>(
        std::ranges::max_element(farness) - farness.begin());
    chosen.push_back(next);
    for (std::size_t i = 0; i < size; ++i) {
      farness[i] = std::min(farness[i], distance(i, next));
    }
    farness[next] = -1;
  }
  return chosen;
}

}  // namespace curvix
