// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). A 2D edge shows one curve.
#pragma once

#include <curvix/edges.h>
#include <vector>

#include "edge_sketch/view_index.h"

namespace curvix {

// The 2D edges of the curves grown so far.
class ClaimedEdges {
 public:
  explicit ClaimedEdges(const std::vector<ViewIndex>& indices);

  bool IsFree(const EdgeRef& ref) const {
    return !is_claimed_[static_cast<std::size_t>(ref.view_idx)]
                       [static_cast<std::size_t>(ref.edge_idx)];
  }
  bool AreFree(const std::vector<EdgeRef>& refs) const;
  std::vector<EdgeRef> FreeOf(std::vector<EdgeRef> refs) const;

  // These and two edges to either side of each along its contour.
  void Claim(const std::vector<EdgeRef>& hits);

 private:
  void ClaimOne(const EdgeRef& ref);

  const std::vector<ViewIndex>& indices_;
  std::vector<std::vector<bool>> is_claimed_;
};

}  // namespace curvix
