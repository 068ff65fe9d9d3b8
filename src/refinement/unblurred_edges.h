// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What blur does to the edges of curves that bend.
//
// The edge of a disc that is blurred by a Gaussian of standard deviation w, the
// detector's own included, appears inside the disc: by w^2 / (2 r) where its
// radius r is 3 w or more. So all views draw small circles too small.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "geometry/edge_geometry.h"
#include "model/posed_view.h"

namespace curvix {

// Three places in a row on a curve; its bend is that of the circle through
// their projections.
using Bend = std::array<Eigen::Vector3d, 3>;

// About the sample `index`: as far as four pixels (of `pixel` world units)
// either way, or to the end of the curve. nullopt if there are fewer than three
// samples.
std::optional<Bend> BendAround(const Curve& curve,
                               std::size_t index,
                               double pixel);

// `edge` of a curve that bends like this, where it would be without blur: moved
// to the outer side of the bend by w^2 / (2 r), w from the edge's sharpness, at
// most by a quarter of a pixel. Edges of unknown sharpness, or without a bend,
// stay.
ImageEdge Unblurred(const Edge2d& edge,
                    const PosedView& view,
                    const std::optional<Bend>& bend);

}  // namespace curvix
