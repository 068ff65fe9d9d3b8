// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The log-likelihood ratio of a 3D edge, from the
// views that support it and those that do not.
//
// What a view shows where a 3D edge projects has a likelihood if the edge is
// real and visible, and one if there is none and other edges are there by
// chance. The logarithm of their ratio is the view's vote:
//   log(A q N(r) N(a) / c + 1 - q)  with an edge at distance r and angle a,
//   log(1 - q)                      without;
// N are normal densities with wide tails, q = 0.9 the share of seen edges that
// are detected, c the density of edges of like direction around the place, and
// A the AppearanceRatio(). Two views that look alike both gain by it, so the
// sum is larger than the log-likelihood ratio of both together.
//
// A real edge is seen from one or two connected regions of viewing directions.
// A view without support between supporting views speaks against it, one far
// from all of them hardly does. Therefore each vote is averaged with those of
// the nearest views in direction, and the log-likelihood ratio of the edge is
// the sum of the positive averages: scattered support cancels.
#pragma once

#include <curvix/edges.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace curvix {

// How bright images are on both sides of an edge. Neighbouring views see a 3D
// edge before the same surfaces, so it looks alike in them; edges that are at
// its projection by chance look as any others do. Grey levels (0..255).
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

// A neighbour of a view in viewing direction, with the weight of its vote.
struct ViewNeighbor {
  int view_idx = 0;
  double weight = 0;  // exp(-(angle / 25 deg)^2 / 2)
};
using NeighborsByView = std::vector<std::vector<ViewNeighbor>>;

// A supporting edge relative to the projected 3D edge.
struct SupportFit {
  double distance_px = 0;  // across the edge
  double sigma_px = 0;     // expected standard deviation of the distance, > 0
  double angle_rad = 0;    // between the directions
};

// The vote of a query view.
struct Vote {
  double position_ratio = 0;  // q N(r) N(a) / c; 0 without a supporting edge
  // Of the supporting edge along the projected 3D edge; nullopt if not known.
  std::optional<Appearance> appearance = std::nullopt;
};
using Votes = std::vector<std::optional<Vote>>;  // by view; none: no query

// A vote with a supporting edge; `density` of like edges per pixel across them,
// > 0.
Vote VoteWithSupport(const SupportFit& fit, double density);

// The vote of a query view without a supporting edge.
Vote VoteWithoutSupport();

// Of a vote whatever the edge looks like, natural logarithm.
double LogLikelihoodRatio(const Vote& vote);

// How much likelier the look of an edge is by what the `neighbors` of its view
// show than by chance: the weighted mean LikelihoodRatio(), the prior that it
// looks like none of them having the weight 0.5. 1 if nothing is known.
double AppearanceRatio(const Vote& vote,
                       const Votes& votes,
                       const std::vector<ViewNeighbor>& neighbors);

// The log-likelihood ratio; `votes` and `neighbors` by view index. >= 0.
double Evidence(const Votes& votes, const NeighborsByView& neighbors);

// Indices of the edges by falling log-likelihood ratio, rounded to 1e-6; ties
// by ascending position.
std::vector<std::size_t> ByFallingEvidence(const std::vector<Edge3d>& edges);

}  // namespace curvix
