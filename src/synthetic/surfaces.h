// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). How the surfaces of a solid look, and images of
// them, with exact pixel areas.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/gray_image.h"
#include "synthetic/face_pattern.h"
#include "synthetic/solid.h"
#include "synthetic/synthetic_scene.h"

namespace curvix {

// What a ray sees. Brightness is smooth where `id` is constant.
struct Look {
  double grey = 0;
  std::uint64_t id = 0;
};

// Faces are lit by fixed lights that cast no shadows, so that all brightness
// edges are edges of the solid, of its outline, or of what is painted on it:
// its patterns, and the texture. What is asked for comes on top: the sun, whose
// shadows have hard edges, and lamps, mirrored in each surface, whose edges
// move over it with the view. Where there are patterns, surfaces are mottled
// besides, without edges.
class Surfaces {
 public:
  // `solid` outlives this. Of `options`, scale, texture, shadows, reflections
  // and seed count.
  Surfaces(const Solid& solid, const SyntheticOptions& options);

  // Where `ray` meets the solid.
  Look At(const Ray& ray, const Hit& hit) const;

  // What is painted on a face; null: nothing.
  const FacePattern* PatternOf(std::size_t primitive_idx, int face_idx) const;

  // Whether the sun shines on a point of the surface, `normal` its unit normal
  // out of the solid. False where the surface looks away from it.
  bool IsSunny(const Eigen::Vector3d& x, const Eigen::Vector3d& normal) const;

  bool has_shadows() const { return options_.shadows; }

  // Towards the sun, unit.
  static const Eigen::Vector3d& SunDirection();

 private:
  double Sunlight(const Eigen::Vector3d& x,
                  const Eigen::Vector3d& normal,
                  std::uint64_t& id) const;

  const Solid& solid_;
  SyntheticOptions options_;
  double mottle_ = 0;  // contrast, grey levels
  std::vector<std::vector<std::unique_ptr<FacePattern>>> patterns_;
};

// The mean of the scene's brightness over each square pixel (a box filter; no
// blur besides), before noise and rounding. Where faces meet inside a pixel,
// the shares of both are measured to about 1/100 of its area; a camera with
// distortion bends the image itself, not a resampled one. Directions that the
// camera model cannot invert show the background.
GrayImage Render(const Solid& solid,
                 const Surfaces& surfaces,
                 const Camera& camera,
                 const Rigid3& cam_from_world);

}  // namespace curvix
