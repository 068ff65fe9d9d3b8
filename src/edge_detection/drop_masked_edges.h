// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). COLMAP's masks: black is what does not count.
#pragma once

#include <cstdint>
#include <vector>

#include "edge_detection/gray_image.h"
#include "edge_detection/third_order_edges.h"

namespace curvix {

// Drops the edges on black pixels of `mask` and keeps the order of the others;
// edges outside it stay. Returns how many it dropped. An outline of the mask
// itself makes no edges, since images are not changed.
std::int32_t DropMaskedEdges(const GrayImage& mask,
                             std::vector<LocatedEdge>* edges);

}  // namespace curvix
