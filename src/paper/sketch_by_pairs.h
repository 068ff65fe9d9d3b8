// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4. The loop as in the paper.
#pragma once

#include <curvix/edges.h>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/cancelled.h"
#include "edge_sketch/sketch_input.h"
#include "geometry/edge_geometry.h"
#include "geometry/epipolar.h"
#include "model/posed_view.h"

namespace curvix {

// Fig. 3(c), support in the intersection of two epipolar wedges: answers, for
// all hypotheses of one pair of hypothesis views, whether one validation view
// supports them.
class WedgeSupport {
 public:
  // `pencil1`: of H1 and `view`; `pencil2`: of H2 and `view`. The edges must
  // outlive it.
  WedgeSupport(const EpipolarPencil& pencil1,
               const EpipolarPencil& pencil2,
               const PosedView& h1,
               const PosedView& h2,
               const PosedView& view,
               const std::vector<Edge2d>& edges,
               double tolerance_px);

  // The edge nearest to `projected` (ties: smaller index) among those in both
  // epipolar wedges, that of `edge1` in H1 and that of `edge2` in H2, and
  // within max_angle_rad of the projected direction. nullopt if there is none.
  std::optional<std::int32_t> Find(const ImageEdge& edge1,
                                   const ImageEdge& edge2,
                                   const ImageEdge& projected,
                                   double max_angle_rad) const;

 private:
  EpipolarAngles angles1_, angles2_;  // of H1 and H2
  EpipolarAngles view_angles2_;       // of the view, with H2
  const std::vector<Edge2d>* edges_;
  double tolerance_px_;
  SortedByAngle sorted1_;
};

// Fig. 3(d), (e): the pairs of views with most unused edges, support in wedges.
EdgeSketch SketchByPairs(const SketchInput& input, const StepDone& step_done);

}  // namespace curvix
