// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5.
#include "neighborhood/support_index.h"

#include <algorithm>

namespace curvix {
namespace {

// Calls f(ref, i) for each support of each edge i, in order.
template <typename F>
void ForEachSupport(const std::vector<Edge3d>& edges, const F& f) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const EdgeRef& ref : edges[i].support) {
      f(ref, static_cast<std::int32_t>(i));
    }
  }
}

// Counts become where each begins; the end is added.
void SumUp(std::vector<std::size_t>& counts) {
  std::size_t sum = 0;
  for (std::size_t& count : counts) {
    const std::size_t begin = sum;
    sum += count;
    count = begin;
  }
  counts.push_back(sum);
}

}  // namespace

SupportIndex::SupportIndex(const std::vector<Edge3d>& edges) {
  ForEachSupport(edges, [&](const EdgeRef& ref, std::int32_t) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    if (view_idx >= view_begins_.size()) view_begins_.resize(view_idx + 1, 0);
    view_begins_[view_idx] = std::max(
        view_begins_[view_idx], static_cast<std::size_t>(ref.edge_idx) + 1);
  });
  SumUp(view_begins_);
  // A counting sort keeps the order of the 3D edges.
  offsets_.assign(view_begins_.back(), 0);
  ForEachSupport(edges, [&](const EdgeRef& ref, std::int32_t) {
    ++offsets_[PlaceOf(ref)];
  });
  SumUp(offsets_);
  edge_idxs_.resize(offsets_.back());
  // Each offset moves on to the next one's place, and back again.
  ForEachSupport(edges, [&](const EdgeRef& ref, std::int32_t edge_idx) {
    edge_idxs_[offsets_[PlaceOf(ref)]++] = edge_idx;
  });
  std::rotate(offsets_.begin(), offsets_.end() - 1, offsets_.end());
  offsets_.front() = 0;
}

bool SupportIndex::IsKnown(const EdgeRef& ref) const {
  const auto view_idx = static_cast<std::size_t>(ref.view_idx);
  return ref.view_idx >= 0 && view_idx + 1 < view_begins_.size() &&
         ref.edge_idx >= 0 && PlaceOf(ref) < view_begins_[view_idx + 1];
}

std::span<const std::int32_t> SupportIndex::SupportedBy(
    const EdgeRef& ref) const {
  if (!IsKnown(ref)) return {};
  const std::size_t place = PlaceOf(ref);
  return {edge_idxs_.data() + offsets_[place],
          offsets_[place + 1] - offsets_[place]};
}

}  // namespace curvix
