// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(a). Epipolar wedges as intervals of epipolar angles.
#pragma once

#include <curvix/edges.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/epipolar.h"
#include "model/posed_view.h"

namespace curvix {

// The wedge of an edge: all epipolar angles of the disc of radius Delta gamma
// around it. Angles wrap at pi: an interval may reach beyond it.
struct Wedge {
  double center = 0;      // radians, (-pi, pi]
  double half_width = 0;  // radians
};

// The wedge of the disc around `pixel` of `view`, one of the pencil's two
// views. nullopt near the baseline, as EpipolarPencil::AngleOf().
std::optional<Wedge> WedgeOf(const EpipolarPencil& pencil,
                             const PosedView& view,
                             const Eigen::Vector2d& pixel,
                             double tolerance_px);

// Whether two wedges of one pencil have an epipolar plane in common.
bool Meet(const Wedge& a, const Wedge& b);

// The edges of one view sorted by their epipolar angle with respect to a
// pencil. Edges near the baseline, which have no depth, are left out.
class SortedByAngle {
 public:
  SortedByAngle(const EpipolarPencil& pencil,
                const PosedView& view,
                const std::vector<Edge2d>& edges,
                double tolerance_px);

  // Edges whose own wedge (their disc has the same tolerance) meets `wedge`, in
  // ascending order of edge index.
  std::vector<std::int32_t> Meeting(const Wedge& wedge) const;

 private:
  struct Entry {
    double angle;
    double half_width;
    std::int32_t edge_idx;
  };
  void Collect(const Wedge& wedge,
               double shift,
               std::vector<std::int32_t>& found) const;

  std::vector<Entry> entries_;  // by angle
  double max_half_width_ = 0;
};

}  // namespace curvix
