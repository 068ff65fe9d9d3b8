// SPDX-License-Identifier: BSD-3-Clause
// Seeded random numbers, the same everywhere.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>

namespace curvix {

// The standard library's distributions differ between implementations.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double Uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double Uniform(double low, double high) {
    return low + (high - low) * Uniform();
  }
  double Normal() {
    const double radius = std::sqrt(-2 * std::log(1 - Uniform()));
    return radius * std::cos(6.28318530717958647692 * Uniform());
  }
  Eigen::Vector3d NormalVector() {
    const double x = Normal(), y = Normal(), z = Normal();
    return {x, y, z};
  }
  Eigen::Vector3d UnitVector() { return NormalVector().normalized(); }
  Eigen::Vector3d Across(const Eigen::Vector3d& tangent) {
    const Eigen::Vector3d offset = NormalVector();
    return offset - offset.dot(tangent) * tangent;
  }
  Eigen::Matrix3d Rotation() {
    Eigen::Quaterniond q;
    for (int i = 0; i < 4; ++i) q.coeffs()[i] = Normal();
    return q.normalized().toRotationMatrix();
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace curvix
