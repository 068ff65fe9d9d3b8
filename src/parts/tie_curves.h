// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Duplicates of samples in several parts, and the ends
// of curves to join.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "model/curve_chains.h"
#include "model/posed_view.h"
#include "model/sample_ranges.h"
#include "parts/scene_parts.h"

namespace curvix {

// A sample of a curve of which another part may have a duplicate.
struct BorderSample {
  std::size_t sample = 0;                              // of the curve
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  // unit
  double pixel = 0;  // PixelSize there, world units
};

// A curve of a part.
struct PartCurve {
  int part_idx = 0;
  std::size_t curve_idx = 0;  // in its part
  std::size_t num_samples = 0;
  bool closed = false;
  bool is_occluding_contour = false;
  std::vector<BorderSample> border_samples;  // ascending
};

// `core`: of the part. Border samples are those within `overlap` on either side
// of a border.
PartCurve MakePartCurve(int part_idx,
                        std::size_t curve_idx,
                        const Curve& curve,
                        const std::vector<Border>& core,
                        double overlap,
                        const std::vector<PosedView>& views);

// A segment of a curve: successive samples that stay.
struct CurveSegment {
  std::size_t curve = 0;
  SampleRange range;
};

// The segments in the order of the curves, and the ties of their ends.
struct TiedSegments {
  std::vector<CurveSegment> segments;
  EndTies ties;
};

// Border samples may have a duplicate in each other part: the nearest sample,
// at most kMaxNormalDistancePx away and options.max_angle_deg off in direction.
// Of duplicates one stays, that of the part whose core holds the place, so
// curves are split into segments. Beyond the end of a segment, its part has
// more samples. The first of these of which a duplicate stays gives the segment
// to which the end is tied. The nearest ends are tied first.
TiedSegments TieSegments(const ScenePartition& partition,
                         const std::vector<PartCurve>& curves,
                         const ConnectivityOptions& options);

}  // namespace curvix
