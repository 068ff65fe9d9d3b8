// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Circles and ellipses in space.
#pragma once

#include <Eigen/Core>

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

}  // namespace curvix
