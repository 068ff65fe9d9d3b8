// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What the files say about a curve beyond geometry.
#pragma once

#include <curvix/curves.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

namespace curvix {

// Of all curves.
std::size_t CountSamples(const CurveSource& curves);

using Rgb = std::array<std::uint8_t, 3>;

// The colour of curve `id`: hues a golden section of the circle apart, so that
// neighbouring ids look different, in three brightnesses.
Rgb CurveColor(std::size_t id);

// The colour of a sign-free unit direction: |x| red, |y| green, |z| blue, as
// tensor images colour it.
Rgb DirectionColor(const Eigen::Vector3d& tangent);

// How far a sample may be trusted, in [0, 1): n / (n + 4) for n supporting
// views. Four views give 0.5, twelve 0.75; a sample that was carried on to a
// corner has none: 0.
float Confidence(std::size_t num_supporting_views);

}  // namespace curvix
