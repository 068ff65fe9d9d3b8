// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include <curvix/curves.h>
#include <algorithm>
#include <array>
#include <cstddef>

namespace curvix {
namespace {

constexpr std::array<std::string_view, kNumCurveKinds> kKindNames = {
    "unknown", "crease", "boundary", "marking", "occluding_contour"};

}  // namespace

std::string_view KindName(CurveKind kind) {
  return kKindNames[static_cast<std::size_t>(kind)];
}

std::optional<CurveKind> KindFromName(std::string_view name) {
  for (std::size_t i = 0; i < kKindNames.size(); ++i) {
    if (kKindNames[i] == name) return static_cast<CurveKind>(i);
  }
  return std::nullopt;
}

CurveKind MainKind(const Curve& curve) {
  std::array<std::size_t, kNumCurveKinds> num_samples = {};
  for (const CurveSample& sample : curve.samples) {
    ++num_samples[static_cast<std::size_t>(sample.kind)];
  }
  const auto most = std::ranges::max_element(num_samples);
  return static_cast<CurveKind>(most - num_samples.begin());
}

}  // namespace curvix
