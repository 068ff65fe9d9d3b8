// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What blur does to edges, and how the brightness of
// the images answers to light.
//
// The edge of a disc that is blurred by a Gaussian of standard deviation w, the
// detector's own included, appears inside the disc: by w^2 / (2 r) where its
// radius r is 3 w or more. So all views draw small circles too small.
//
// What blurs before the detector, lens, pixel or renderer, blurs light. If
// brightness does not grow in proportion to light but ever slower, the steepest
// place of a blurred step is on its dark side.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "curve_refinement/refinement_input.h"
#include "geometry/adjust_edge.h"
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

// How the brightness I (0..1) of the images answers to light: d light / d I is
// proportional to I^(px[0] / b) (1 - I)^(-px[1] / b), where b is 0.56 of the
// standard deviation of the blur of light in pixels. px[0] is 0 or more, that
// of a gamma, px[1] that of a shoulder, on which highlights saturate. Both 0:
// brightness is light.
struct ResponseCurve {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
};

// How far, in pixels, `edge` is on the dark side of where it would be without
// blur, for each pixel of ResponseCurve::px: half its contrast over its level I
// and over 1 - I; the contrast is that of a blurred step as strong and as
// sharp. Zero if a side is black or white (to 1.5 %), where brightness does not
// tell light, and for edges of unknown sharpness.
Eigen::Vector2d ResponseShift(const Edge2d& edge);

// `edge` of a curve that bends like this, where it would be without blur: from
// where the finer scale sees it (Edge2d::fine_px), moved to the bright side by
// ResponseShift(), and to the outer side of the bend by w^2 / (2 r), w from the
// edge's sharpness and EdgeMap::fine_variance_gain_px2, at most by a quarter of
// a pixel. Edges of unknown sharpness stay there.
ImageEdge Unblurred(const Edge2d& edge,
                    const PosedView& view,
                    const std::optional<Bend>& bend,
                    const ResponseCurve& response,
                    double fine_variance_gain_px2);

// The 2D edges of a sample, one after the other, where they would be without
// blur. `pixel`: the size of a pixel there, world units.
std::vector<PlaneMeasurement> MeasureUnblurred(const Curve& curve,
                                               std::size_t index,
                                               double pixel,
                                               const RefinementInput& input,
                                               const ResponseCurve& response);

// The response curve with which the views agree best about the curves. A curve
// that some views see against the sky and others against a wall has an edge of
// another contrast and level in each, so a response curve moves it by another
// amount in each, or to the other side. Only the part of the residuals that
// moving the sample cannot absorb determines the response. Least squares with
// Cauchy's weights (input.edge_sigma_px) over samples some ten pixels apart, in
// turn with their places; neither parameter is below 0, since no camera's
// brightness grows faster than light; a weak prior pulls to the identity, so
// that few curves change nothing.
ResponseCurve EstimateResponseCurve(const std::vector<Curve>& curves,
                                    const RefinementInput& input);

}  // namespace curvix
