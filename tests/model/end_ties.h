// SPDX-License-Identifier: BSD-3-Clause
// Ends of items that are tied to each other.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "model/curve_chains.h"

namespace curvix {

constexpr EndIdx Head(std::size_t item) { return 2 * item; }
constexpr EndIdx Tail(std::size_t item) { return 2 * item + 1; }

inline EndTies Tied(std::size_t num_items,
                    const std::vector<std::pair<EndIdx, EndIdx>>& pairs) {
  EndTies ties(2 * num_items);
  for (const auto& [a, b] : pairs) {
    ties[a] = b;
    ties[b] = a;
  }
  return ties;
}

}  // namespace curvix
