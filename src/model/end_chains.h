// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6. Items with two ends, strung together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace curvix {

// End 2 i is the front of item i (where its direction points), 2 i + 1 its
// back.
using EndIdx = std::size_t;

inline EndIdx OtherEnd(EndIdx end) { return end ^ 1; }
inline std::size_t ItemOf(EndIdx end) { return end / 2; }
inline bool IsFront(EndIdx end) { return end % 2 == 0; }

// The end that each end is tied to, if any; mutual. The two ends of one item
// may be tied to each other.
using EndTies = std::vector<std::optional<EndIdx>>;

struct ChainItem {
  std::size_t item = 0;
  bool flipped = false;  // runs from front to back
};

// Items from back to front. If `closed`, the last is tied to the first.
struct EndChain {
  bool closed = false;
  std::vector<ChainItem> items;
};

// All items in chains, single ones included. Each chain is found from its
// smallest item, forwards and then backwards (Sec. 6); that item is not flipped
// and comes first in a closed chain. The chains are in the order of their
// smallest items. Needs ties.size() even and mutual ties.
std::vector<EndChain> FollowEnds(const EndTies& ties);

// A pair of ends that could be tied, and how badly they fit.
struct EndPair {
  double cost = 0;
  EndIdx a = 0;
  EndIdx b = 0;
};

// Ties pairs in the order of their cost, then of their smaller and larger end,
// while both ends are free.
EndTies TieCheapestFirst(std::vector<EndPair> pairs, std::size_t num_items);

}  // namespace curvix
