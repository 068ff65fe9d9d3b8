// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which curves are edges of the scene.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>

#include <vector>

#include "model/posed_view.h"

namespace curvix {

struct SelectedCurves {
  std::vector<Curve> edges;
  std::vector<Curve> occluding_contours;  // labelled
};

// Sorts the curves that the views confirm, each kind in the given order. A
// curve (curve_traits.h) is
//  * left out as a border of shading, if more than options.max_blurred_share of
//    its edges are blurred,
//  * left out as chance, if its evidence is below options.min_evidence,
//  * an occluding contour, if its evidence is below
//      options.min_evidence * max(1, s / (3 r))^2
//                           * max(1, sigma' / options.sigma_scale_px)^2,
//    s its scatter, and r that of good curves of this scene: what is left of
//    the errors of edges, cameras and poses; sigma' is its sigma, but where its
//    edges scatter less than the 0.15 px that sigmas assume, in proportion;
//  * an edge of the scene, otherwise.
// The rim of a smooth body lies elsewhere in every view, so its edges scatter,
// and shows from directions in one plane, so it is badly determined; a whole
// curve of edges is recognised more surely than each of them. r is the lower
// quartile, by length, of the scatter of curves that would be edges without the
// term in s; at least 0.06 px, which sampling by pixels leaves. Curves whose
// sigma is not known or that have no support count as edges.
SelectedCurves SelectCurves(std::vector<Curve> curves,
                            const std::vector<PosedView>& views,
                            const std::vector<EdgeMap>& edge_maps,
                            const CurveRefinementOptions& options,
                            int num_threads);

}  // namespace curvix
