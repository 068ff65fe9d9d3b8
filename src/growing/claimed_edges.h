// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). A 2D edge shows one curve.
#pragma once

#include <curvix/edges.h>

#include <cstddef>
#include <vector>

#include "validation/view_index.h"

namespace curvix {

// Which 2D edges the curves have that were grown so far.
class ClaimedEdges {
 public:
  explicit ClaimedEdges(const std::vector<ViewIndex>& indices);

  bool IsFree(const EdgeRef& ref) const {
    return !is_claimed_[static_cast<std::size_t>(ref.view_idx)]
                       [static_cast<std::size_t>(ref.edge_idx)];
  }
  std::size_t NumFree(const std::vector<EdgeRef>& refs) const;

  // Claims `hits` and two edges to either side along their contours.
  void Claim(const std::vector<EdgeRef>& hits);

  // Gives back what was claimed since the last call of Keep().
  void GiveBack();
  void Keep() { recent_.clear(); }

 private:
  void ClaimOne(const EdgeRef& ref);

  const std::vector<ViewIndex>& indices_;
  std::vector<std::vector<bool>> is_claimed_;
  std::vector<EdgeRef> recent_;
};

}  // namespace curvix
