// SPDX-License-Identifier: BSD-3-Clause
#include "model/connectivity_graph.h"

#include "base/check.h"

namespace curvix {
namespace {

using Neighbors = std::vector<std::optional<std::int32_t>>;

// Every link of `there` must lead back by `back`.
void CheckMutual(const Neighbors& there, const Neighbors& back) {
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (!there[i].has_value()) continue;
    const auto j = static_cast<std::size_t>(*there[i]);
    CURVIX_CHECK(j < back.size() && j != i, "edge " << i << " leads to " << j);
    CURVIX_CHECK(back[j] == static_cast<std::int32_t>(i),
                 "link from " << i << " to " << j << " is not mutual");
  }
}

}  // namespace

void Validate(const ConnectivityGraph& graph) {
  CURVIX_CHECK(graph.backward.size() == graph.forward.size() &&
                   graph.flipped.size() == graph.forward.size(),
               "parts differ in length");
  CheckMutual(graph.forward, graph.backward);
  CheckMutual(graph.backward, graph.forward);
}

}  // namespace curvix
