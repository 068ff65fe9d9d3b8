// SPDX-License-Identifier: BSD-3-Clause
// Paper: none.
#include <curvix/curves.h>
#include <array>
#include <cstddef>

namespace curvix {
namespace {

constexpr std::array<std::string_view, 5> kKindNames = {
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

}  // namespace curvix
