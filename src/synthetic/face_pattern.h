// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What is painted on a face, with exact outlines.
#pragma once

#include "synthetic/face_frame.h"
#include "synthetic/primitive.h"
#include "synthetic/true_curve.h"

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace curvix {

// Patches of even tone in the coordinates of a face, see FaceFromOwn.
class FacePattern {
 public:
  struct Value {
    double tone = 1;             // factor on the grey value of the face
    std::uint64_t patch_id = 0;  // changes where the tone jumps
  };

  virtual ~FacePattern() = default;
  virtual Value At(const Eigen::Vector2d& uv) const = 0;

  // Where the tone jumps, in the plane z = 0 of (u, v): lines and arcs that the
  // face may cut off. Tones to both sides differ by an eighth at least.
  virtual std::vector<TrueCurve> Outlines() const = 0;
};

// Bricks in mortar, wooden boards' grain or print that fit `area`; `unit` is
// the size of the scene: a brick is about 0.15 x 0.065 units. Null for kNone,
// for faces too narrow to hold a pattern, and for grain on a round side.
std::unique_ptr<FacePattern> MakeFacePattern(SurfacePattern pattern,
                                             const FaceArea& area,
                                             double unit,
                                             std::uint64_t seed);

}  // namespace curvix
