// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Edges from the image to its ideal pinhole, and
// without those on masks.
#pragma once

#include <curvix/edges.h>
#include <curvix/scene.h>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/gray_image.h"
#include "edge_detection/third_order_edges.h"

namespace curvix {

// Carries the edges of `distorted`, in pixels of the camera's images, to the
// camera's ideal pinhole: positions, those of Edge2d::fine_px too, through the
// inverse of the distortion, tangents through its derivative, the bright side
// unchanged. Strengths and sharpness stay those of the image. Edges that the
// camera model cannot invert, or where it mirrors the image, are dropped and
// links to them removed; the others keep their order. Pinhole cameras give back
// what they got.
EdgeMap UndistortEdges(EdgeMap distorted, const Camera& camera);

// The edges of the ideal pinhole of `from` in that of `to`, in the same order;
// nothing if `to` cannot be inverted at one of them. The unseen cells stay:
// cameras are refined by less than a cell.
std::optional<EdgeMap> CarryEdges(const EdgeMap& edges,
                                  const Camera& from,
                                  const Camera& to);

// Masks are COLMAP's: black is what does not count. Drops the edges on black
// pixels of `mask` and keeps the order of the others; edges outside it stay.
// Returns how many it dropped. An outline of the mask itself makes no edges,
// since images are not changed.
std::int32_t DropMaskedEdges(const GrayImage& mask,
                             std::vector<LocatedEdge>* edges);

// A cell is unseen if a corner is or, with a mask, the middle of a side or its
// middle; none of a pinhole camera without a mask.
UnseenCells FindUnseenCells(const Camera& camera,
                            const std::optional<GrayImage>& mask);

}  // namespace curvix
