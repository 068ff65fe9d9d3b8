// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Edges from the image to its ideal pinhole.
#pragma once

#include <curvix/edges.h>
#include <curvix/scene.h>

#include <optional>

namespace curvix {

// Carries the edges of `distorted`, in pixels of the camera's images, to the
// camera's ideal pinhole: positions through the inverse of the distortion,
// tangents through its derivative, the bright side unchanged. Strengths stay
// those of the image. Edges that the camera model cannot invert, or where it
// mirrors the image, are dropped and links to them removed; the others keep
// their order. Pinhole cameras give back what they got.
EdgeMap UndistortEdges(EdgeMap distorted, const Camera& camera);

// The edges of the ideal pinhole of `from` in that of `to`, in the same order;
// nothing if `to` cannot be inverted at one of them.
std::optional<EdgeMap> CarryEdges(const EdgeMap& edges,
                                  const Camera& from,
                                  const Camera& to);

}  // namespace curvix
