// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5. From 2D edges back to the 3D edges that they support.
#pragma once

#include <curvix/edges.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace curvix {

// The support lists of 3D edges, inverted. 8 bytes per 2D edge and 4 per
// support.
class SupportIndex {
 public:
  explicit SupportIndex(const std::vector<Edge3d>& edges);

  // The 3D edges that `ref` supports, ascending; empty if none.
  std::span<const std::int32_t> SupportedBy(const EdgeRef& ref) const;

 private:
  // Whether `ref` is within the edges that support anything, view by view.
  bool IsKnown(const EdgeRef& ref) const;
  std::size_t PlaceOf(const EdgeRef& ref) const {
    return view_begins_[static_cast<std::size_t>(ref.view_idx)] +
           static_cast<std::size_t>(ref.edge_idx);
  }

  // The place of each view's first edge, and the end: up to its last edge that
  // supports anything.
  std::vector<std::size_t> view_begins_;
  std::vector<std::size_t> offsets_;  // by place, into edge_idxs_, and the end
  std::vector<std::int32_t> edge_idxs_;
};

}  // namespace curvix
