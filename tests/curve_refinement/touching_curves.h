// SPDX-License-Identifier: BSD-3-Clause
// Two curves that touch each other, for tests of the refinement.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/curve_refinement/drawn_curves.h"

namespace curvix {

// About a sample per pixel; sample kTouchIdx of both lies in the origin, where
// both run along x.
inline constexpr int kTouchIdx = 90;
inline constexpr double kTouchRadiusPx = 150;

// An arc that bends upwards (z).
inline Curve ArcUpwards() {
  Curve curve;
  for (int i = 0; i <= 2 * kTouchIdx; ++i) {
    const double angle = (i - kTouchIdx) / kTouchRadiusPx;
    const double sine = std::sin(angle), cosine = std::cos(angle);
    curve.samples.push_back(SampleAt(kTouchRadiusPx * InPlane(sine, 1 - cosine),
                                     {cosine, 0, sine}));
  }
  return curve;
}

// One that bends away from the camera (y).
inline Curve ArcBackwards() {
  Curve curve = ArcUpwards();
  for (CurveSample& sample : curve.samples) {
    std::swap(sample.position.y(), sample.position.z());
    std::swap(sample.tangent.y(), sample.tangent.z());
  }
  return curve;
}

inline Curve Slice(const Curve& curve, int begin, int end) {
  Curve slice;
  slice.samples.assign(curve.samples.begin() + begin,
                       curve.samples.begin() + end);
  return slice;
}

}  // namespace curvix
