// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5. From 2D edges back to the 3D edges that they support.
#pragma once

#include <curvix/edges.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace curvix {

// The support lists of 3D edges, inverted. 8 bytes per 2D edge in use and 4 per
// support.
class SupportIndex {
 public:
  explicit SupportIndex(const std::vector<Edge3d>& edges);

  // The 3D edges that `ref` supports, ascending; empty if none. A binary
  // search.
  std::span<const std::int32_t> SupportedBy(const EdgeRef& ref) const;

 private:
  std::vector<EdgeRef> refs_;  // ascending, without repeats
  std::vector<std::size_t> offsets_;
  std::vector<std::int32_t> edge_idxs_;
};

}  // namespace curvix
