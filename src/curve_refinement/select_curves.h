// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What the 2D edges behind a curve say about it, and
// which curves are edges of the scene.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <optional>
#include <vector>

#include "curve_refinement/image_support.h"
#include "model/posed_view.h"

namespace curvix {

// A real edge of the scene is a step in the image, as sharp as the image can
// show it, and keeps its place as the view moves. Of what else shows as an
// edge, a shading edge, where a blend meets a face, is blurred, and an
// occluding contour lies elsewhere on its body in every view. Along a whole
// curve noise averages out, and both show.
struct CurveTraits {
  // How many times less surely than one 2D edge, across it, the place of the
  // curve is known: the median over the samples of sigma in pixels
  // (pixel_size.h) over that of an edge. It falls with the number of supporting
  // views, and grows where their rays lie in one plane and where their edges
  // are off by more than edges should be.
  double dilution = 0;
  // That of the middle sample, if all views that look at it supported it,
  // exactly.
  double least_dilution = 0;
  // 1.48 times the median distance of the supporting edges from the projected
  // samples, which for normal errors is their standard deviation. Pixels.
  double scatter_px = 0;
  // The share of the supporting edges that lie in views in which this curve is
  // blurred: the median sharpness of its edges there is below
  // LeastSharpness(). 0..1.
  double blurred_share = 0;
  // The dilution that edges of the other views alone leave. Infinite, if fewer
  // than two of them support most samples.
  double sharp_dilution = 0;
};

// Of each view, how sharp a curve must be not to count as blurred: 0.7 of the
// median sharpness of the steeper half of its edges, or five standard
// deviations below it, if these differ more, as in photographs, of which some
// parts are out of focus. The standard deviation is that of the logarithm, from
// the lower quartile. 0 if it is not known: then nothing counts as blurred.
std::vector<double> LeastSharpness(const std::vector<EdgeMap>& edge_maps);

// `edge_sigma_px`: the standard deviation of a 2D edge's place that the sigmas
// of samples assume, > 0. nullopt if no sample has both a sigma and support.
std::optional<CurveTraits> MeasureCurve(
    const Curve& curve,
    const std::vector<PosedView>& views,
    const std::vector<EdgeMap>& edge_maps,
    const std::vector<double>& least_sharpness,
    double edge_sigma_px);

struct SelectedCurves {
  std::vector<Curve> edges;
  std::vector<Curve> occluding_contours;  // labelled
};

// Sorts the curves, each kind in the given order. A curve is
//  * an occluding contour, if
//      dilution * max(1, s / r) > allowed * (1 - max(0, l) / 4)
//    with s its scatter, r that of good curves of this scene, l its
//    ContourLogLikelihoodRatio(), and allowed options.max_dilution; where views
//    cannot tell places so well, 6 times the least dilution, up to 1.6
//    options.max_dilution; of crowded images (AreCrowded()) l is 0, and allowed
//    15 times the least dilution,
//  * an edge of the scene, if also
//      sharp dilution * max(1, s / r)
//          <= allowed * (1 - max(0, l) / 4) * (1 - blurred / max_blurred_share)
//    or options.max_blurred_share is 1,
//  * dropped as a shading edge, otherwise.
// An occluding contour lies elsewhere in every view, so its edges scatter,
// and shows from directions in one plane, so it is badly determined; what views
// show by chance scatters, too. r is what is left of the errors of edges,
// cameras and poses: the lower quartile of the scatter of the sharpest curves,
// weighted by length / dilution^2; at least 0.06 px, which sampling by pixels
// leaves. Curves whose sigma is not known or that have no support count as
// edges; if options.max_dilution is 0, all do. `images`: of these views and
// edge maps. `edge_sigma_px`: as of MeasureCurve().
SelectedCurves SelectCurves(std::vector<Curve> curves,
                            const std::vector<PosedView>& views,
                            const std::vector<EdgeMap>& edge_maps,
                            const ImageSupport& images,
                            double edge_sigma_px,
                            const CurveRefinementOptions& options,
                            int num_threads);

}  // namespace curvix
