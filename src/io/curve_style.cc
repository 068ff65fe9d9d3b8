// SPDX-License-Identifier: BSD-3-Clause
#include "io/curve_style.h"

#include <algorithm>
#include <cmath>

namespace curvix {
namespace {

std::uint8_t ToByte(double unit) {
  return static_cast<std::uint8_t>(
      std::lround(255 * std::clamp(unit, 0.0, 1.0)));
}

// One channel of HSV -> RGB; `offset` is 5, 3, 1 for red, green, blue.
double HsvChannel(double offset, double hue, double saturation, double value) {
  const double k = std::fmod(offset + 6 * hue, 6.0);
  return value - value * saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
}

}  // namespace

std::size_t CountSamples(const CurveSource& curves) {
  std::size_t num_samples = 0;
  curves.ForEach([&](std::size_t, const Curve& curve) {
    num_samples += curve.samples.size();
  });
  return num_samples;
}

Rgb CurveColor(std::size_t id) {
  constexpr double kGoldenSection = 0.6180339887498949;
  constexpr std::array<double, 3> kValues = {0.95, 0.75, 0.55};
  const double index = static_cast<double>(id % 1000003);
  const double hue = std::fmod(index * kGoldenSection, 1.0);
  const double value = kValues[id % kValues.size()];
  Rgb rgb;
  for (std::size_t c = 0; c < 3; ++c) {
    const double offset = 5 - 2 * static_cast<double>(c);
    rgb[c] = ToByte(HsvChannel(offset, hue, 0.85, value));
  }
  return rgb;
}

Rgb DirectionColor(const Eigen::Vector3d& tangent) {
  return {ToByte(std::abs(tangent.x())),
          ToByte(std::abs(tangent.y())),
          ToByte(std::abs(tangent.z()))};
}

float Confidence(std::size_t num_supporting_views) {
  const float n = static_cast<float>(num_supporting_views);
  return n / (n + 4);
}

}  // namespace curvix
