// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "synthetic/surface_texture.h"

#include "synthetic/counter_random.h"

#include <algorithm>

namespace curvix {
namespace {

using Eigen::Vector3d;

// The patch of one cell of a cubic grid; lengths in cells.
struct Patch {
  Vector3d centre;
  double radius;
  double strength;  // in +-1
  bool is_crisp;
};

Patch PatchOfCell(const Eigen::Vector3i& cell, std::uint64_t id) {
  Patch patch;
  for (int axis = 0; axis < 3; ++axis) {
    patch.centre[axis] =
        cell[axis] + Uniform(Mix(id, static_cast<std::uint64_t>(axis)));
  }
  patch.radius = 0.25 + 0.4 * Uniform(Mix(id, 3));
  const double level = 2 * Uniform(Mix(id, 4)) - 1;
  patch.strength = level + (level < 0 ? -0.3 : 0.3);
  patch.is_crisp = Uniform(Mix(id, 5)) < 0.5;
  return patch;
}

std::uint64_t CellId(const Eigen::Vector3i& cell, std::uint64_t seed) {
  std::uint64_t id = seed;
  for (int axis = 0; axis < 3; ++axis) {
    id = Mix(id, static_cast<std::uint64_t>(cell[axis]));
  }
  return id;
}

}  // namespace

SurfaceTexture::Value SurfaceTexture::At(const Vector3d& world) const {
  Value value;
  if (contrast_ == 0) return value;
  const Vector3d x = world / cell_size_;
  const Eigen::Vector3i home = x.array().floor().cast<int>();
  double sum = 0;
  for (int k = 0; k < 27; ++k) {
    const Eigen::Vector3i cell =
        home + Eigen::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const std::uint64_t id = CellId(cell, seed_);
    const Patch patch = PatchOfCell(cell, id);
    const double share =
        (x - patch.centre).squaredNorm() / (patch.radius * patch.radius);
    if (share >= 1) continue;
    sum += patch.strength * (patch.is_crisp ? 1 : (1 - share) * (1 - share));
    if (patch.is_crisp) value.patch_id ^= id;
  }
  value.grey = contrast_ / 2 * std::clamp(sum, -1.0, 1.0);
  return value;
}

}  // namespace curvix
