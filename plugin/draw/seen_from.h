// SPDX-License-Identifier: BSD-3-Clause
// Which lines the photographs show from one side.
#pragma once

#include <curvix/fitting.h>
#include <curvix/scene.h>
#include <vector>

#include "plugin/align/curves_file.h"

namespace curvix {

enum class SeenFrom {
  kUnknown,  // fewer than three photographs look from there
  kSeen,
  kHidden,  // fewer than one in ten of them show it
};

// Whether photographs show `fit` from where `toward` points: those whose rays
// to it are within 45 degrees of that and that have it in the image. What is
// shown is what supports its samples, of which some are looked at. `scene` is
// in the frame of the samples.
SeenFrom SeenFromSide(const CurveFit& fit,
                      const std::vector<SeenSample>& samples,
                      const Eigen::Vector3d& toward,
                      const Scene& scene);

// The curves without the primitives that photographs from there do not show.
// `curves` has samples.
FittedCurves WithoutHidden(const CurvesFile& curves,
                           const Eigen::Vector3d& toward,
                           const Scene& scene);

}  // namespace curvix
