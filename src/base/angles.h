// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Angles and their differences.
#pragma once

#include <cmath>

namespace curvix {

inline constexpr double kPi = 3.14159265358979323846;

inline constexpr double DegToRad(double degrees) { return degrees * kPi / 180; }
inline constexpr double RadToDeg(double radians) { return radians * 180 / kPi; }

// `angle` brought into (-pi, pi].
inline double WrapDirected(double angle) {
  const double wrapped = std::remainder(angle, 2 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

// `angle` brought into (-pi/2, pi/2]: directions that differ by pi are one.
inline double WrapUndirected(double angle) {
  const double wrapped = std::remainder(angle, kPi);
  return wrapped <= -kPi / 2 ? kPi / 2 : wrapped;
}

// |a - b| between two lines, in [0, pi/2].
inline double UndirectedDifference(double a, double b) {
  return std::abs(std::remainder(a - b, kPi));
}

}  // namespace curvix
