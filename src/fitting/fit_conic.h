// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Circles and ellipses in space.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "fitting/fit_samples.h"

namespace curvix {

// center + frame * (a cos t, b sin t, 0). A circle has a = b.
struct Conic {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();  // a rotation
  double a = 1;                                         // >= b > 0
  double b = 1;

  // In the frame: x and y in the plane, z off it.
  Eigen::Vector3d Local(const Eigen::Vector3d& point) const {
    return frame.transpose() * (point - center);
  }
  Eigen::Vector3d At(double t) const;
  // Unit, towards larger t.
  Eigen::Vector3d Tangent(double t) const;
};

// The parameter t, in (-pi, pi], of the point of the conic that is nearest to
// `point`. For ellipses by iteration on the centre of curvature, good to far
// below one part in a million near the ellipse.
double NearestParameter(const Conic& conic, const Eigen::Vector3d& point);

// Of the point from the conic.
double SquaredDistance(const Conic& conic, const Eigen::Vector3d& point);

// The circle with the least robust algebraic error in the plane of the samples:
// quick, and where FitCircle starts. nullopt: fewer than three samples, or they
// lie on a line.
std::optional<Conic> RoughCircle(FitSpan samples);

// The circle or ellipse with the least robust sum of squared distances.
// nullopt: fewer samples than 4 or 6, all nearly on a line, an ellipse with
// axes more than 20 to 1, or no convergence.
std::optional<Conic> FitCircle(FitSpan samples);
std::optional<Conic> FitEllipse(FitSpan samples);

// `conic` moved to fit `samples` as well as it can while its ends, those next
// to the first and the last sample, lie on `start` and `end` where these are
// given, of a circle to 0.05 standard deviations. A circle stays one.
// nullopt: no circle does, but a straight line.
std::optional<Conic> FitThrough(const Conic& conic,
                                FitSpan samples,
                                const std::optional<Eigen::Vector3d>& start,
                                const std::optional<Eigen::Vector3d>& end);

}  // namespace curvix
