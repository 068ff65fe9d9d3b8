// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6.
#include "model/end_chains.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/check.h"

namespace curvix {
namespace {

// Leaves item `start` by `end` and walks on to the last item or back to
// `start`; returns the items on the way, without `start`, in order.
// `flipped` is whether walking from front to back counts as flipped.
std::vector<ChainItem> Walk(const EndTies& ties, EndIdx end, bool forward) {
  const std::size_t start = ItemOf(end);
  std::vector<ChainItem> items;
  while (ties[end].has_value() && ItemOf(*ties[end]) != start) {
    const EndIdx entered = *ties[end];
    items.push_back({ItemOf(entered), IsFront(entered) == forward});
    end = OtherEnd(entered);
  }
  return items;
}

bool IsClosed(const EndTies& ties,
              std::size_t start,
              const std::vector<ChainItem>& ahead) {
  const EndIdx front =
      ahead.empty() ? 2 * start
                    : 2 * ahead.back().item + (ahead.back().flipped ? 1 : 0);
  return ties[front] == 2 * start + 1;
}

EndChain ChainThrough(const EndTies& ties, std::size_t start) {
  std::vector<ChainItem> ahead = Walk(ties, 2 * start, true);
  EndChain chain;
  chain.closed = IsClosed(ties, start, ahead);
  if (!chain.closed) {
    chain.items = Walk(ties, 2 * start + 1, false);
    std::reverse(chain.items.begin(), chain.items.end());
  }
  chain.items.push_back({start, false});
  chain.items.insert(chain.items.end(), ahead.begin(), ahead.end());
  return chain;
}

}  // namespace

std::vector<EndChain> FollowEnds(const EndTies& ties) {
  CURVIX_CHECK(ties.size() % 2 == 0, ties.size() << " ends");
  for (EndIdx end = 0; end < ties.size(); ++end) {
    CURVIX_CHECK(!ties[end].has_value() ||
                     (*ties[end] < ties.size() && ties[*ties[end]] == end),
                 "the tie of end " << end << " is not mutual");
  }
  std::vector<bool> is_traced(ties.size() / 2, false);
  std::vector<EndChain> chains;
  for (std::size_t item = 0; item < is_traced.size(); ++item) {
    if (is_traced[item]) continue;
    chains.push_back(ChainThrough(ties, item));
    for (const ChainItem& link : chains.back().items) {
      is_traced[link.item] = true;
    }
  }
  return chains;
}

EndTies TieCheapestFirst(std::vector<EndPair> pairs, std::size_t num_items) {
  for (EndPair& pair : pairs) {
    if (pair.b < pair.a) std::swap(pair.a, pair.b);
  }
  std::sort(pairs.begin(), pairs.end(), [](const auto& x, const auto& y) {
    return std::tie(x.cost, x.a, x.b) < std::tie(y.cost, y.a, y.b);
  });
  EndTies ties(2 * num_items);
  for (const EndPair& pair : pairs) {
    if (ties[pair.a].has_value() || ties[pair.b].has_value()) continue;
    ties[pair.a] = pair.b;
    ties[pair.b] = pair.a;
  }
  return ties;
}

}  // namespace curvix
