// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(a), (b) and Sec. 4, Fig. 5. From an H1 edge to
// hypotheses.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "consolidation/cluster_edges.h"
#include "geometry/edge_geometry.h"
#include "geometry/epipolar.h"
#include "geometry/epipolar_wedge.h"
#include "model/posed_view.h"

namespace curvix {

// One H1 edge paired with one virtual edge of H2 (paper, Sec. 4).
struct Hypothesis {
  SpaceEdge edge;
  ImageEdge edge1;                    // as detected in H1
  ImageEdge edge2;                    // virtual, in H2
  std::vector<std::int32_t> members;  // edges of H2 that edge2 stands for
};

// The edges of H2 ready to be paired with those of H1.
class HypothesisViews {
 public:
  // nullopt if the views share their centre.
  static std::optional<HypothesisViews> Make(const PosedView& h1,
                                             const PosedView& h2,
                                             const std::vector<Edge2d>& edges2,
                                             const Options& options);

  // Candidates in the epipolar wedge of `edge1`, moved onto its epipolar line,
  // clustered, triangulated; in order along the line. None for an edge that
  // runs along its epipolar line in H1; virtual edges that do so in H2 or give
  // no 3D edge are left out.
  std::vector<Hypothesis> Hypothesise(const Edge2d& edge1) const;

  const PosedView& h1() const { return *h1_; }
  const PosedView& h2() const { return *h2_; }

 private:
  HypothesisViews(const EpipolarPencil& pencil,
                  const PosedView& h1,
                  const PosedView& h2,
                  const std::vector<Edge2d>& edges2,
                  const Options& options);

  bool RunsAlongEpipolarLine(const ImageEdge& edge1) const;

  const PosedView *h1_, *h2_;
  const Options* options_;
  EpipolarPencil pencil_;
  Eigen::Matrix3d fundamental_;
  SortedByAngle sorted2_;
  std::vector<LineEdge> edges2_;  // as detected, in the order of sorted2_
};

}  // namespace curvix
