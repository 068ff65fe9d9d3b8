// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/claimed_edges.h"

#include <algorithm>

#include "model/contours.h"

namespace curvix {
namespace {

constexpr int kLinksAlongContour = 2;

}  // namespace

ClaimedEdges::ClaimedEdges(const std::vector<ViewIndex>& indices)
    : indices_(indices) {
  for (const ViewIndex& index : indices) {
    is_claimed_.emplace_back(index.edges->edges.size(), false);
  }
}

bool ClaimedEdges::AreFree(const std::vector<EdgeRef>& refs) const {
  return std::all_of(refs.begin(), refs.end(), [this](const EdgeRef& ref) {
    return IsFree(ref);
  });
}

std::vector<EdgeRef> ClaimedEdges::FreeOf(std::vector<EdgeRef> refs) const {
  std::erase_if(refs, [this](const EdgeRef& ref) { return !IsFree(ref); });
  return refs;
}

void ClaimedEdges::Claim(const std::vector<EdgeRef>& hits) {
  for (const EdgeRef& hit : hits) {
    ClaimOne(hit);
    ForEachAlongContour(
        indices_[static_cast<std::size_t>(hit.view_idx)].edges->neighbors,
        hit.edge_idx,
        kLinksAlongContour,
        [&](std::int32_t edge_idx) {
          ClaimOne({hit.view_idx, edge_idx});
        });
  }
}

void ClaimedEdges::ClaimOne(const EdgeRef& ref) {
  is_claimed_[static_cast<std::size_t>(ref.view_idx)]
             [static_cast<std::size_t>(ref.edge_idx)] = true;
}

}  // namespace curvix
