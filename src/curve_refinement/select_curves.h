// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What the 2D edges behind a curve say about it, and
// which curves are edges of the scene.
#pragma once

#include <curvix/curves.h>
#include <vector>

#include "curve_refinement/image_support.h"
#include "curve_refinement/refinement_input.h"

namespace curvix {

// What SelectCurves() keeps.
struct SelectedCurves {
  std::vector<Curve> edges;
  std::vector<Curve> occluding_contours;  // labelled
};

// A real edge of the scene is a step in the image, as sharp as the image can
// show it, and keeps its place as the view moves. Of what else shows as an
// edge, a shading edge, where a blend meets a face, is blurred, and an
// occluding contour lies elsewhere on its body in every view. Along a whole
// curve noise averages out, and both show.
//
//  * Dilution: how many times less surely than one 2D edge, across it, the
//    place of the curve is known; the least: if all views that look at it
//    supported it; the sharp: by the views in which it is not blurred.
//  * Scatter: standard deviation of the supporting edges about the projected
//    samples, pixels.
//  * Blurred: the share of the supporting edges that lie in views in which the
//    curve is less sharp than most edges.
//
// Sorts the curves, each kind in the given order. A curve is
//  * an occluding contour, if
//      dilution * max(1, s / r) > allowed * (1 - max(0, l) / 4)
//    with s its scatter, r that of good curves of this scene, l its
//    ContourLogLikelihoodRatio(), and allowed input.options.max_dilution; where
//    views cannot tell places so well, 6 times the least dilution, up to 1.6
//    input.options.max_dilution; of crowded images (AreCrowded()) l is 0, and
//    allowed 15 times the least dilution,
//  * an edge of the scene, if also
//      sharp dilution * max(1, s / r)
//          <= allowed * (1 - max(0, l) / 4) * (1 - blurred / max_blurred_share)
//    or input.options.max_blurred_share is 1,
//  * dropped as a shading edge, otherwise.
// An occluding contour lies elsewhere in every view, so its edges scatter,
// and shows from directions in one plane, so it is badly determined; what views
// show by chance scatters, too. r is what is left of the errors of edges,
// cameras and poses: the lower quartile of the scatter of the sharpest curves,
// weighted by length / dilution^2; at least 0.06 px, which sampling by pixels
// leaves. Curves whose sigma is not known or that have no support count as
// edges; if input.options.max_dilution is 0, all do. `images`: of the views and
// edge maps of `input`.
SelectedCurves SelectCurves(std::vector<Curve> curves,
                            const RefinementInput& input,
                            const ImageSupport& images);

}  // namespace curvix
