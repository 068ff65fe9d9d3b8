// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How a curve goes on beyond its end.
#pragma once

#include <curvix/curves.h>

#include <Eigen/Core>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// A stretch of a curve before one of its ends, in pixels (pixel_size.h) from
// the last sample.
struct EndStretch {
  double begin_px = 0;  // samples nearer to the end are left out
  double end_px = 15;
};

// A line or an arc through the last samples of a curve. Arc lengths count from
// the point nearest to the last sample, on beyond the end.
struct EndFit {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // at arc length 0
  Eigen::Vector3d outward = Eigen::Vector3d::UnitX();  // unit, out of the curve
  Eigen::Vector3d bend = Eigen::Vector3d::Zero();  // 1 / radius, to the centre
  double length = 0;  // of the fitted samples, world units; 0: no fit
  double rms = 0;     // distance of the samples, world units
  double pixel = 0;   // world units

  Eigen::Vector3d PointAt(double arc_length) const;
  Eigen::Vector3d DirectionAt(double arc_length) const;  // unit
  // Of the point nearest to `point`, at most a quarter of a turn off.
  double ArcLengthTo(const Eigen::Vector3d& point) const;
};

// Fits the samples in `stretch`, few outliers aside, by a line, or by an arc of
// any radius where it comes nearer to them than their scatter explains; length
// is 0 if they are fewer than five or of no extent, or the curve is closed.
EndFit FitEnd(const Curve& curve,
              bool front,
              const EndStretch& stretch,
              const std::vector<PosedView>& views);

// The fit to the last 15, 25, 40 or 60 px, the last three of them aside, which
// corners bend: the longest that fits to 0.25 px or about as well as the first.
EndFit FitLongEnd(const Curve& curve,
                  bool front,
                  const std::vector<PosedView>& views);

}  // namespace curvix
