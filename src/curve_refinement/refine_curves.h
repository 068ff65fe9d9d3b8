// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). From traced curves to curves as one would draw them.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "curve_refinement/image_support.h"
#include "curve_refinement/refinement_input.h"
#include "curve_refinement/response_curve.h"
#include "model/posed_view.h"

namespace curvix {

// Ten steps, below in their order: those that select, smooth, separate curves
// that touch, close gaps, fit to all images (response_curve.h), flatten, cut at
// touches and at corners, and carry ends on to corners; curves shorter than
// input.options.min_length_px are dropped unless they join two junctions; the
// last estimates covariances. Occluding contours that options keep are
// smoothed, not fitted. Without input.options.enabled, the curves as they are.
// Between steps, and between curves in the longest, input.step_done is asked.
std::vector<Curve> RefineCurves(const std::vector<Curve>& curves,
                                const RefinementInput& input);

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
//    allowed 30 times the least dilution,
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

// Moves each sample onto a parabola in arc length fitted to the samples around
// it, with weights that fall off as a Gaussian of standard deviation
// input.options.smoothing_px (0: nothing moves) and with the samples' variance,
// and turns its tangent to the parabola's. Ends are fitted from one side;
// closed curves go round. Curves of fewer than five samples stay as they are.
std::vector<Curve> SmoothCurves(const std::vector<Curve>& curves,
                                const RefinementInput& input);

// Where two curves touch, the shared segment is traced once: one curve breaks,
// or the two are swapped behind it. Wherever two ends meet beside a passing
// curve, both curves are carried on through what they share, exchanged if need
// be: the last 3 px before the ends are cut off, and gaps are filled
// (StringTogetherFilled()).
std::vector<Curve> SeparateTouching(std::vector<Curve> curves,
                                    const RefinementInput& input,
                                    const ImageSupport& images);

// Joins open ends that continue each other at their own curvature: the arcs
// that fit before the two ends (curve_ends.h), carried on over the gap, arrive
// at each other's ends. Gaps are no longer than what was fitted, nor than
// input.options.max_gap_px, except where the images show the curve in the gap.
// The ends that are missed least come first; ties by the order of curves. Bent
// last samples and overlaps of joined ends are cut off; other ends keep them,
// since most are contours of the images. The gap is filled with samples on the
// cubic that fits both ends; they have the sigma and evidence of the weaker
// end, and the 2D edges nearby. A curve whose own ends meet becomes closed.
std::vector<Curve> BridgeGaps(std::vector<Curve> curves,
                              const RefinementInput& input,
                              const ImageSupport& images);

// Moves the samples of each curve across it to where they best agree with all
// their 2D edges in all views, under the assumption that curves bend evenly:
// the least, by Ceres, of
//   sum rho1(d / input.edge_sigma_px) + sum rho2(b^3 |x'''| / (0.05 px)),
// where d is the distance of a projected sample from the line of its 2D edge,
// which stands where it would without blur (response_curve.h, in images of
// this response curve), b is 1.2 input.options.smoothing_px, x''' is the third
// derivative by arc length of four samples in a row, small for all smooth
// curves, and the losses are Cauchy's: a wrong 2D edge hardly pulls, and a kink
// that the images show stays. So noise goes on lengths of some b and curvature
// stays. Tangents become those of SetTangentsAlongChords().
// Curves of fewer than six samples stay; smoothing_px = 0 returns the input.
// Samples that come to lie 2 px or more from their 2D edges (median) are cut
// out; what is left of a curve is one or several, in order.
// Pixels in space as in pixel_size.h.
std::vector<Curve> FitToImages(std::vector<Curve> curves,
                               const RefinementInput& input,
                               const ResponseCurve& response);

// Sets each tangent along the chord between the samples two before and behind.
void SetTangentsAlongChords(Curve& curve);

// Puts curves into planes where images hardly determine their depth, as along
// the baseline: there, errors that continue along 2D edges bend curves in
// depth, and most curves of man-made scenes are planar. Samples move along the
// rays from the mean centre of the supporting cameras into the plane that
// agrees best with all 2D edges, with Cauchy's loss of input.edge_sigma_px. A
// weak prior prefers planes across the rays. A curve moves only if
//  * in no view that supports a quarter of its samples it moves by more than
//    4 input.edge_sigma_px (root mean square), so that one view from elsewhere
//    keeps it as it is, and
//  * in space, in pixels, it moves more than three times as far as in images.
// Curves of fewer than six samples stay; smoothing_px = 0 returns the input.
// Pixels in space as in pixel_size.h.
std::vector<Curve> FlattenCurves(std::vector<Curve> curves,
                                 const RefinementInput& input,
                                 const ResponseCurve& response);

// Cuts two curves where they touch, so that all four pieces end in one place:
// amid the segments of at most 120 px along which either is within 2 px and 10
// degrees of the other, if they come within 1 px there and both go on for 5 px
// or more. Nearest pairs first, ties by the order of curves and samples. The
// pieces take the place of the curve. Pixels as in pixel_size.h.
std::vector<Curve> CutAtTouches(std::vector<Curve> curves,
                                const RefinementInput& input);

// Cuts curves at corners of more than input.options.max_corner_deg: samples
// where a line or arc fits before and another behind, much better than one
// parabola fits both, and the two meet at a larger angle than either of them
// turns by. Bends have no such sample. Of samples near each other the one with
// the best fit is cut, ties by their order, and is in both pieces. The pieces
// are in the order of the curves.
std::vector<Curve> CutCorners(const std::vector<Curve>& curves,
                              const RefinementInput& input);

// Carries curves on to the corners at which they meet. An edge detector rounds
// corners by its own width, so the last pixels before one are missing or bent:
// each open end is continued along the line or arc (curve_ends.h) fitted to the
// samples 2.5 to 20 px before it, or nearly all of a curve too short for that.
// Ends that so pass each other, no more than 1.5 px from the point nearest to
// all their tangents there, at most input.options.junction_reach_px and the
// length of the fitted samples from both and at more than 10 degrees, form a
// junction: that point. The curves are cut 2.5 px before their ends and carried
// on to it: samples of one junction are equal to the last bit. Junctions are
// formed by rising gap, ties by the order of curves; an end belongs to one
// junction. Ends in one place that continue each other, as where curves touch
// (CutAtTouches()), stay. Pixels as in pixel_size.h.
std::vector<Curve> MeetAtJunctions(std::vector<Curve> curves,
                                   const RefinementInput& input);

// Sets the covariance and the sigma of each sample from how well the views
// agree about the segment of the curve around it. Errors of 2D edges go on
// along an edge, so a view counts as one measurement: the mean distance of its
// edges, without their blur (response_curve.h, in images of this response
// curve), from the projected segment, with weights that fall off as a Gaussian
// of standard deviation input.options.smoothing_px, or one pixel. The
// covariance is
//   s^2 A^-1 (sum_vw rho_vw a_v a_w^T) A^-1,  A = sum_v a_v a_v^T,
// where a_v is how fast the distance in view v grows, in pixels per world unit,
// rho_vw the correlation of two views, which falls with the angle between their
// rays, and s the standard deviation of the mean distances, robustly (Huber's,
// for Cauchy's loss of input.edge_sigma_px); where few views see the segment, s
// leans on that of all curves together.
//
// What all views have in common, as when all poses are off alike, is not in
// it. Samples without two views that cross stay as they are.
std::vector<Curve> EstimateCovariances(std::vector<Curve> curves,
                                       const RefinementInput& input,
                                       const ResponseCurve& response);

}  // namespace curvix
