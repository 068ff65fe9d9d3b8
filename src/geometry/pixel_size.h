// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The local unit of length of Sec. 6, and curves
// that are short in it.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <vector>

#include "geometry/edge_geometry.h"
#include "model/posed_view.h"

namespace curvix {

// The length in space, world units, that fills one pixel of `view` at
// `position`, if it lies parallel to the image: depth / focal length; infinite
// if the view does not have it in front.
double PixelSizeIn(const PosedView& view, const Eigen::Vector3d& position);

// The length in space, world units, that fills one pixel at `position` in the
// view that sees it largest, if it lies parallel to the image: the smallest
// depth / focal length over the views of `support`; if none of these has it in
// front, over those that have it in their image; if there are none, over all
// that have it in front. 0 if no view has.
//
// Limits in multiples of it do not depend on the scale of the scene, and suit
// near and far places alike.
double PixelSize(const Eigen::Vector3d& position,
                 const std::vector<EdgeRef>& support,
                 const std::vector<PosedView>& views);

// At the median sample of a curve; 0 without samples.
double PixelSize(const Curve& curve, const std::vector<PosedView>& views);

// At an edge or a sample of a curve: what has a position and support.
template <typename Supported>
double PixelSize(const Supported& place, const std::vector<PosedView>& views) {
  return PixelSize(place.position, place.support, views);
}

// Edges and ends further off each other's tangent lines, in pixels of this
// size, are not of one curve: traces would jump between parallel tracks.
inline constexpr double kMaxNormalDistancePx = 1.5;

// The length in space, world units, that fills one pixel along the tangent of
// `edge` in the view of `support` that sees it largest; longer than PixelSize()
// where the edge leads towards the views. 0 if none of the
// views has it in front, infinite if it leads to the centre of all.
double PixelSizeAlong(const SpaceEdge& edge,
                      const std::vector<EdgeRef>& support,
                      const std::vector<PosedView>& views);

// The pixel size of each edge.
std::vector<double> PixelSizes(const std::vector<Edge3d>& edges,
                               const std::vector<PosedView>& views);

// The length of a curve in pixels: every segment in pixels of the view that
// sees it largest, whatever the angle at which it sees it.
double LengthInPixels(const Curve& curve, const std::vector<PosedView>& views);

// Whether it has fewer than two samples or is shorter than `min_length_px`.
bool IsShort(const Curve& curve,
             const std::vector<PosedView>& views,
             double min_length_px);

// Whether it leads from one junction to another; they are indexed.
bool LeadsSomewhere(const Curve& curve);

// Without the short curves, unless they lead from one junction, that is a place
// of ends equal to the last bit, to another.
std::vector<Curve> DropLooseShortCurves(std::vector<Curve> curves,
                                        const std::vector<PosedView>& views,
                                        double min_length_px);

}  // namespace curvix
