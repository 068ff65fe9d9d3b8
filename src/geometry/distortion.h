// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// Numbers that carry their derivatives with respect to two variables, so that a
// formula written once as a template gives its value and its exact Jacobian.
#pragma once

#include <curvix/scene.h>
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

// The formulas of COLMAP's camera models, up to focal lengths and principal
// point: from ideal image coordinates (u, v) to distorted ones (x, y), where
// pixel = (fx x + cx, fy y + cy). T is double or Dual2.

template <typename T>
struct PlanePoint {
  T x;
  T y;
};

// The number of leading parameters that are focal lengths: 1 for f, cx, cy and
// 2 for fx, fy, cx, cy.
constexpr int NumFocalLengths(CameraModel model) {
  switch (model) {
    case CameraModel::kSimplePinhole:
    case CameraModel::kSimpleRadial:
    case CameraModel::kRadial:
    case CameraModel::kSimpleRadialFisheye:
    case CameraModel::kRadialFisheye:
    case CameraModel::kSimpleDivision:
    case CameraModel::kSimpleFisheye:
      return 1;
    default:
      return 2;
  }
}

// 1 + k[0] r2 + k[1] r2^2 + ... + k[n-1] r2^n.
template <typename T>
T RadialFactor(const T& r2, const double* k, int n) {
  T sum(0);
  for (int i = n - 1; i >= 0; --i) sum = r2 * (T(k[i]) + sum);
  return T(1) + sum;
}

template <typename T>
PlanePoint<T> Scaled(const PlanePoint<T>& p, const T& factor) {
  return {p.x * factor, p.y * factor};
}

template <typename T>
T SquaredNorm(const PlanePoint<T>& p) {
  return p.x * p.x + p.y * p.y;
}

// Decentering at `p`: (2 p1 xy + p2 (r2 + 2 x2), 2 p2 xy + p1 (r2 + 2 y2)).
template <typename T>
PlanePoint<T> Decentering(const PlanePoint<T>& p, double p1, double p2) {
  const T r2 = SquaredNorm(p);
  const T xy2 = T(2) * p.x * p.y;
  return {T(p1) * xy2 + T(p2) * (r2 + T(2) * p.x * p.x),
          T(p2) * xy2 + T(p1) * (r2 + T(2) * p.y * p.y)};
}

template <typename T>
PlanePoint<T> Sum(const PlanePoint<T>& a, const PlanePoint<T>& b) {
  return {a.x + b.x, a.y + b.y};
}

// The equidistant fisheye: the angle to the optical axis becomes the radius.
template <typename T>
PlanePoint<T> Equidistant(const PlanePoint<T>& p) {
  return Scaled(p, AtanOverX(SquaredNorm(p)));
}

// OPENCV; k = k1, k2, p1, p2.
template <typename T>
PlanePoint<T> DistortOpenCV(const PlanePoint<T>& p, const double* k) {
  return Sum(Scaled(p, RadialFactor(SquaredNorm(p), k, 2)),
             Decentering(p, k[2], k[3]));
}

// FULL_OPENCV; k = k1, k2, p1, p2, k3, k4, k5, k6.
template <typename T>
PlanePoint<T> DistortFullOpenCV(const PlanePoint<T>& p, const double* k) {
  const double numerator[] = {k[0], k[1], k[4]};
  const T r2 = SquaredNorm(p);
  const T radial = RadialFactor(r2, numerator, 3) / RadialFactor(r2, k + 5, 3);
  return Sum(Scaled(p, radial), Decentering(p, k[2], k[3]));
}

// FOV: radius atan(2 r tan(w/2)) / w. Its limit for w = 0 is no distortion.
template <typename T>
PlanePoint<T> DistortFov(const PlanePoint<T>& p, double omega) {
  const double h = omega / 2;
  const double tan_over_h =
      std::abs(h) < 1e-4 ? 1 + h * h / 3 : std::tan(h) / h;
  const double tan2 = 2 * h * tan_over_h;  // 2 tan(w/2)
  return Scaled(p, T(tan_over_h) * AtanOverX(T(tan2 * tan2) * SquaredNorm(p)));
}

// THIN_PRISM_FISHEYE after the fisheye; k = k1, k2, p1, p2, k3, k4, sx1, sy1.
template <typename T>
PlanePoint<T> DistortThinPrism(const PlanePoint<T>& p, const double* k) {
  const double radial[] = {k[0], k[1], k[4], k[5]};
  const T r2 = SquaredNorm(p);
  return Sum(
      Sum(Scaled(p, RadialFactor(r2, radial, 4)), Decentering(p, k[2], k[3])),
      {T(k[6]) * r2, T(k[7]) * r2});
}

// RAD_TAN_THIN_PRISM_FISHEYE after the fisheye; k = k0..k5, p0, p1, s0..s3.
// Decentering and prism act on the radially distorted point.
template <typename T>
PlanePoint<T> DistortRadTanThinPrism(const PlanePoint<T>& p, const double* k) {
  const PlanePoint<T> q = Scaled(p, RadialFactor(SquaredNorm(p), k, 6));
  const T r2 = SquaredNorm(q);
  const T r4 = r2 * r2;
  return Sum(Sum(q, Decentering(q, k[7], k[6])),
             {T(k[8]) * r2 + T(k[9]) * r4, T(k[10]) * r2 + T(k[11]) * r4});
}

// DIVISION: the undistorted point is q / (1 + k |q|^2); this is its inverse,
// NaN where no q exists (4 k r2 > 1).
template <typename T>
PlanePoint<T> DistortDivision(const PlanePoint<T>& p, double k) {
  using std::sqrt;
  return Scaled(p, T(2) / (T(1) + sqrt(T(1) - T(4 * k) * SquaredNorm(p))));
}

// EUCM for Z = 1.
template <typename T>
PlanePoint<T> DistortEucm(const PlanePoint<T>& p, double alpha, double beta) {
  using std::sqrt;
  const T depth = T(alpha) * sqrt(T(beta) * SquaredNorm(p) + T(1));
  return Scaled(p, T(1) / (depth + T(1 - alpha)));
}

// (x, y) of the ideal point `p`; `camera` is valid.
template <typename T>
PlanePoint<T> Distort(const Camera& camera, const PlanePoint<T>& p) {
  const double* k = camera.params.data() + NumFocalLengths(camera.model) + 2;
  const auto radial = [k](const PlanePoint<T>& q, int n) {
    return Scaled(q, RadialFactor(SquaredNorm(q), k, n));
  };
  switch (camera.model) {
    case CameraModel::kSimplePinhole:
    case CameraModel::kPinhole:
      break;
    case CameraModel::kSimpleRadial:
      return radial(p, 1);
    case CameraModel::kRadial:
      return radial(p, 2);
    case CameraModel::kOpenCV:
      return DistortOpenCV(p, k);
    case CameraModel::kOpenCVFisheye:
      return radial(Equidistant(p), 4);
    case CameraModel::kFullOpenCV:
      return DistortFullOpenCV(p, k);
    case CameraModel::kFov:
      return DistortFov(p, k[0]);
    case CameraModel::kSimpleRadialFisheye:
      return radial(Equidistant(p), 1);
    case CameraModel::kRadialFisheye:
      return radial(Equidistant(p), 2);
    case CameraModel::kThinPrismFisheye:
      return DistortThinPrism(Equidistant(p), k);
    case CameraModel::kRadTanThinPrismFisheye:
      return DistortRadTanThinPrism(Equidistant(p), k);
    case CameraModel::kSimpleDivision:
    case CameraModel::kDivision:
      return DistortDivision(p, k[0]);
    case CameraModel::kSimpleFisheye:
    case CameraModel::kFisheye:
      return Equidistant(p);
    case CameraModel::kEucm:
      return DistortEucm(p, k[0], k[1]);
  }
  return p;
}

}  // namespace curvix
