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
  double radius;    // at most 0.5, so that 8 cells are near any point
  double strength;  // in +-1.2
  bool is_crisp;
};

// The i-th 21 of the 63 upper bits, in [0, 1).
double Third(std::uint64_t mixed, int i) {
  return static_cast<double>(mixed << (21 * i) >> 43) * 0x1.0p-21;
}

Patch PatchOfCell(const Eigen::Vector3i& cell, std::uint64_t id) {
  const std::uint64_t other = Mix(id);
  const double level = 2 * Third(other, 1) - 1;
  return {
      cell.cast<double>() + Vector3d(Third(id, 0), Third(id, 1), Third(id, 2)),
      0.25 + 0.25 * Third(other, 0),
      level + (level < 0 ? -0.2 : 0.2),
      Third(other, 2) < 0.5};
}

std::uint64_t CellId(const Eigen::Vector3i& cell, std::uint64_t seed) {
  std::uint64_t packed = 0;
  for (int axis = 0; axis < 3; ++axis) {
    packed =
        (packed << 21) + static_cast<std::uint64_t>(cell[axis] + (1 << 20));
  }
  return Mix(seed ^ packed);
}

}  // namespace

SurfaceTexture::Value SurfaceTexture::At(const Vector3d& world) const {
  Value value;
  if (contrast_ == 0) return value;
  const Vector3d x = world / cell_size_;
  const Eigen::Vector3i home = (x.array() - 0.5).floor().cast<int>();
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3i cell =
        home + Eigen::Vector3i(k & 1, k >> 1 & 1, k >> 2);
    const std::uint64_t id = CellId(cell, seed_);
    const Patch patch = PatchOfCell(cell, id);
    const double share =
        (x - patch.centre).squaredNorm() / (patch.radius * patch.radius);
    if (share >= 1) continue;
    const bool is_crisp = patch.is_crisp && rims_ == Rims::kSome;
    sum += patch.strength * (is_crisp ? 1 : (1 - share) * (1 - share));
    if (is_crisp) value.patch_id ^= id;
  }
  value.grey = contrast_ / 2 * std::clamp(sum, -1.0, 1.0);
  return value;
}

}  // namespace curvix
