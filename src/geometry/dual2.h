// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// Numbers that carry their derivatives with respect to two variables, so that a
// formula written once as a template gives its value and its exact Jacobian.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace curvix {

// f(u, v) and its gradient (df/du, df/dv).
struct Dual2 {
  double value = 0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();

  Dual2() = default;
  Dual2(double constant) : value(constant) {}  // NOLINT: implicit
  Dual2(double v, const Eigen::Vector2d& g) : value(v), gradient(g) {}
};

inline Dual2 operator+(const Dual2& a, const Dual2& b) {
  return {a.value + b.value, a.gradient + b.gradient};
}
inline Dual2 operator-(const Dual2& a, const Dual2& b) {
  return {a.value - b.value, a.gradient - b.gradient};
}
inline Dual2 operator*(const Dual2& a, const Dual2& b) {
  return {a.value * b.value, a.value * b.gradient + b.value * a.gradient};
}
inline Dual2 operator/(const Dual2& a, const Dual2& b) {
  const double value = a.value / b.value;
  return {value, (a.gradient - value * b.gradient) / b.value};
}
// NaN for a negative argument; the gradient at 0 is infinite.
inline Dual2 sqrt(const Dual2& a) {
  const double value = std::sqrt(a.value);
  return {value, a.gradient / (2 * value)};
}

// atan(x) / x as a function of x^2 >= 0: smooth at 0, where it is 1.
inline double AtanOverX(double x2) {
  if (x2 < 1e-4) {  // the next term of the series is below 1e-20
    return 1 - x2 * (1. / 3 - x2 * (1. / 5 - x2 * (1. / 7 - x2 / 9)));
  }
  const double x = std::sqrt(x2);
  return std::atan(x) / x;
}
inline Dual2 AtanOverX(const Dual2& x2) {
  const double value = AtanOverX(x2.value);
  const double z = x2.value;
  const double slope = z < 1e-4
                           ? -1. / 3 + z * (2. / 5 - z * (3. / 7 - z * 4. / 9))
                           : (1 / (1 + z) - value) / (2 * z);
  return {value, slope * x2.gradient};
}

}  // namespace curvix
