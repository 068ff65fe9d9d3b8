// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(a), (b) and Sec. 4, Fig. 5. From an H1 edge to
// hypotheses. Deviation: edges that look unlike may be left out, which halves
// the number of hypotheses of photographs; see docs/paper_map.md.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

#include "edge_sketch/consolidate.h"
#include "edge_sketch/evidence.h"
#include "edge_sketch/view_overlap.h"
#include "geometry/edge_geometry.h"
#include "geometry/epipolar.h"
#include "model/posed_view.h"

namespace curvix {

// Hypotheses of one H1 edge with less than this share of the best one's support
// are dropped: of several (Sec. 3), all may hold if they are about as good.
inline constexpr double kMinRelativeSupport = 0.6;

// One H1 edge paired with one virtual edge of H2 (paper, Sec. 4).
struct Hypothesis {
  SpaceEdge edge;
  ImageEdge edge1;    // as detected in H1
  VirtualEdge edge2;  // in H2
};

// The hypotheses of one H1 edge.
struct Hypotheses {
  std::vector<Hypothesis> hypotheses;  // in order along the epipolar line
  VirtualEdges virtual_edges;          // also those without a hypothesis
};

// The edges of H2, indexed for pairing with those of H1.
class HypothesisViews {
 public:
  // Only hypotheses at `depths` of H1. `pencil`: of both views. The views, the
  // edges, the options and `appearance2` must outlive this. With `appearance2`,
  // of the edges of H2, edges whose sides are not about as bright as those of
  // the H1 edge, in the same order along the epipolar lines, are no candidates.
  // Edges of unknown sharpness are.
  HypothesisViews(const EpipolarPencil& pencil,
                  const PosedView& h1,
                  const PosedView& h2,
                  const std::vector<Edge2d>& edges2,
                  const DepthRange& depths,
                  const Options& options,
                  const AppearanceDensity* appearance2 = nullptr);

  // Candidates in the epipolar wedge of `edge1`, moved onto its epipolar line,
  // clustered and triangulated. None for an edge that runs along its epipolar
  // line in H1. Virtual edges that do so in H2, or give no 3D edge, are left
  // out.
  Hypotheses Hypothesise(const Edge2d& edge1) const;

  const PosedView& h1() const { return *h1_; }
  const PosedView& h2() const { return *h2_; }

 private:
  // Whether the sides of both edges are about as bright; true where that is not
  // known. `tangent2`: of `edge2`. `cross_alike`: the tangents of both cross
  // their epipolar lines to the same side.
  bool LookAlike(const Appearance& look1,
                 const Edge2d& edge2,
                 const Eigen::Vector2d& tangent2,
                 bool cross_alike) const;
  // The part of the epipolar line of `pixel1` that shows `depths_`, extended by
  // the longest slide of an edge. Pixels along the line.
  Interval SearchAlong(const Line2& line, const Eigen::Vector2d& pixel1) const;
  // Of the angle between an H1 edge and its epipolar line; positive if the edge
  // leads to the side to which, in H2, the normal of EpipolarLine() points.
  double CrossingSine(const ImageEdge& edge1) const;

  const PosedView *h1_, *h2_;
  const std::vector<Edge2d>* edges2_;
  const AppearanceDensity* appearance2_;
  const Options* options_;
  Eigen::Vector3d baseline_;  // unit, from h1 to h2, world
  EpipolarAngles angles1_;
  Eigen::Matrix3d line_from_normal_;  // of a plane, in h1's camera frame
  Eigen::Matrix3d fundamental_;
  DepthRange depths_;
  RayProjection projection_;
  SortedByAngle sorted2_;
};

}  // namespace curvix
