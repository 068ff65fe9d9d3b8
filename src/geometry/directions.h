// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Directions in space.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace curvix {

// Directions of a larger standard deviation are not known.
constexpr double kKnownDeg = 1.5;

using AcrossAxes = Eigen::Matrix<double, 3, 2>;

// Two columns of unit length, orthogonal to each other and to `tangent`, which
// has unit length. Together they are right-handed: tangent, first, second.
inline AcrossAxes AxesAcross(const Eigen::Vector3d& tangent) {
  AcrossAxes axes;
  axes.col(0) = tangent.unitOrthogonal();
  axes.col(1) = tangent.cross(axes.col(0));
  return axes;
}

// CrossMatrix(v) * w is v x w.
inline Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

// In [0, pi], of vectors of any length; exact for small angles, too.
inline double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The rotation by the least angle that brings the direction of `from` to that
// of `to`; the vectors may have any length but 0.
inline Eigen::Quaterniond ShortestRotation(const Eigen::Vector3d& from,
                                           const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

// By |turn| about `turn`.
inline Eigen::Quaterniond RotationBy(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (!(angle > 0)) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
}

// The direction or its opposite, whichever has its largest component positive.
inline Eigen::Vector3d Upright(const Eigen::Vector3d& direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction(largest) < 0 ? -direction : direction;
}

}  // namespace curvix
