// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5.
#include "neighborhood/support_index.h"

#include <algorithm>
#include <utility>

namespace curvix {

SupportIndex::SupportIndex(const std::vector<Edge3d>& edges) {
  std::vector<std::pair<EdgeRef, std::int32_t>> pairs;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const EdgeRef& ref : edges[i].support) {
      pairs.emplace_back(ref, static_cast<std::int32_t>(i));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  edge_idxs_.reserve(pairs.size());
  for (const auto& [ref, edge_idx] : pairs) {
    if (refs_.empty() || !(refs_.back() == ref)) {
      refs_.push_back(ref);
      offsets_.push_back(edge_idxs_.size());
    }
    edge_idxs_.push_back(edge_idx);
  }
  offsets_.push_back(edge_idxs_.size());
}

std::span<const std::int32_t> SupportIndex::SupportedBy(
    const EdgeRef& ref) const {
  const auto found = std::lower_bound(refs_.begin(), refs_.end(), ref);
  if (found == refs_.end() || !(*found == ref)) return {};
  const auto i = static_cast<std::size_t>(found - refs_.begin());
  return {edge_idxs_.data() + offsets_[i], offsets_[i + 1] - offsets_[i]};
}

}  // namespace curvix
