// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Circles and ellipses.
#pragma once

#include <optional>

#include "fitting/conic.h"
#include "fitting/fit_samples.h"

namespace curvix {

// The circle with the least robust algebraic error in the plane of the samples:
// quick, and where FitCircle starts. nullopt: fewer than three samples, or they
// lie on a line.
std::optional<Conic> RoughCircle(const FitSamples& samples);

// The circle or ellipse with the least robust sum of squared distances.
// nullopt: fewer samples than 4 or 6, all nearly on a line, an ellipse with
// axes more than 20 to 1, or no convergence.
std::optional<Conic> FitCircle(const FitSamples& samples);
std::optional<Conic> FitEllipse(const FitSamples& samples);

// Moves `conic` to fit `samples` as well as it can while it passes through
// `points`, to about a hundredth of a standard deviation. A circle stays one.
Conic FitThrough(const Conic& conic,
                 const FitSamples& samples,
                 const std::vector<Eigen::Vector3d>& points);

// Standard deviation of the radius of a circle that was fitted to `samples`,
// as they lie, with independent errors of their sigmas.
double RadiusSigma(const Conic& circle, const FitSamples& samples);

}  // namespace curvix
