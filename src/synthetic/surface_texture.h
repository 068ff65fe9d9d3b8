// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). A pattern in space that surfaces cut out of.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace curvix {

// Round patches at random places: a surface that passes through them shows what
// feature detectors look for. All fade to their rims, or half of them end there
// with a crisp rim.
class SurfaceTexture {
 public:
  enum class Rims { kNone, kSome };

  // contrast: grey levels between the brightest and the darkest patch.
  // cell_size: mean distance of patches, world units.
  SurfaceTexture(double contrast,
                 double cell_size,
                 std::uint64_t seed,
                 Rims rims)
      : contrast_(contrast), cell_size_(cell_size), seed_(seed), rims_(rims) {}

  struct Value {
    double grey = 0;             // to be added, within +-contrast / 2
    std::uint64_t patch_id = 0;  // changes where the grey value jumps
  };
  Value At(const Eigen::Vector3d& world) const;

 private:
  double contrast_;
  double cell_size_;
  std::uint64_t seed_;
  Rims rims_;
};

}  // namespace curvix
