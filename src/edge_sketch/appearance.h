// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How bright images are on both sides of an edge.
// Neighbouring views see a 3D edge before the same surfaces, so it looks alike
// in them; edges that are at its projection by chance look as any others do.
#pragma once

#include <curvix/edges.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace curvix {

// Grey levels (0..255).
struct Appearance {
  float level = 0;          // half-way between both sides
  float half_contrast = 0;  // right of a direction along the edge over `level`
  // Of edges that look so among all of the view, per square grey level; > 0.
  float density = 1;

  // As along the opposite direction.
  void SwapSides() { half_contrast = -half_contrast; }
};

// Along the tangent of the edge, without its density; nullopt if the sharpness
// of the edge is not known.
std::optional<Appearance> AppearanceAlong(const Edge2d& edge);

// How much likelier an edge looks like `a` if another view shows it like `b`
// (whose density does not matter) than by chance; at most 15, since things
// repeat. Levels differ by a Cauchy distribution of scale 7, half contrasts by
// one of scale 3.5, as they do in photographs; their long tails stand for sides
// that do not belong to the surface of the edge.
double LikelihoodRatio(const Appearance& a, const Appearance& b);

// How many edges of a view look alike.
class AppearanceDensity {
 public:
  AppearanceDensity();  // of no edges: all are equally frequent
  explicit AppearanceDensity(const std::vector<Edge2d>& edges);

  // `direction` along the edge, signed as its 3D tangent; its right is where
  // (-y, x) points. nullopt if the sharpness of the edge is not known.
  std::optional<Appearance> AppearanceOf(
      const Edge2d& edge, const Eigen::Vector2d& direction) const;

 private:
  static constexpr std::size_t kNumLevels = 16;
  static constexpr std::size_t kNumContrasts = 8;

  struct WeightedBin {
    std::size_t index = 0;
    double weight = 0;  // those of an edge sum up to 1
  };

  static std::array<WeightedBin, 4> BinsOf(const Edge2d& edge);
  static std::pair<WeightedBin, WeightedBin> BinsAround(double grey_levels,
                                                        std::size_t num_bins);

  std::array<double, kNumLevels * kNumContrasts> densities_;
};

}  // namespace curvix
