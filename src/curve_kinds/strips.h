// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How well the images agree on a surface beside a
// curve.
#pragma once

#include <curvix/curves.h>
#include <curvix/scene.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "curve_kinds/blurred_images.h"
#include "model/posed_view.h"

namespace curvix {

// Directions about the tangent of a curve, in equal steps from `normal`
// towards tangent x normal.
constexpr int kNumDirections = 24;

// A place on a curve.
struct StripPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  // unit
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();   // unit, across it
  std::vector<EdgeRef> support;
};

// The logarithm of a Bayes factor for each side of a curve in the images and
// each direction: that a surface which begins at the curve and leads in this
// direction shows on this side, against that the views show different things
// there. Side 0 is that on which the direction of the camera, turned by less
// than half a turn from `normal` towards tangent x normal, is seen.
// Minus infinity for directions that fewer than three views face; 0 for all if
// there are no three views.
struct SurfaceEvidence {
  std::array<std::array<float, kNumDirections>, 2> log_bayes = {};
};

// One view per scene view in `images`, `views` and `cameras`, whose ideal
// pinholes the views are.
SurfaceEvidence CompareStrips(const StripPlace& place,
                              const std::vector<PosedView>& views,
                              const std::vector<const Camera*>& cameras,
                              const std::vector<BlurredImage>& images);

}  // namespace curvix
