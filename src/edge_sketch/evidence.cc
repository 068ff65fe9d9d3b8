// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/angles.h"
#include "geometry/detected_edge.h"

namespace curvix {
namespace {

constexpr double kLevelScale = 7;
constexpr double kContrastScale = 3.5;
constexpr double kMaxRatio = 15;
constexpr double kBinWidth = 16;  // grey levels
// Of edges that look like none of the view.
constexpr double kShareOfUnlike = 0.1;

double Cauchy(double x, double scale) {
  return 1 / (kPi * scale * (1 + (x / scale) * (x / scale)));
}

}  // namespace

std::optional<Appearance> AppearanceAlong(const Edge2d& edge) {
  if (!(edge.sharpness > 0)) return std::nullopt;
  return Appearance{static_cast<float>(edge.level),
                    static_cast<float>(HalfContrast(edge))};
}

double LikelihoodRatio(const Appearance& a, const Appearance& b) {
  const double alike =
      Cauchy(static_cast<double>(a.level - b.level), kLevelScale) *
      Cauchy(static_cast<double>(a.half_contrast - b.half_contrast),
             kContrastScale);
  return std::min(kMaxRatio, alike / static_cast<double>(a.density));
}

AppearanceDensity::AppearanceDensity()
    : AppearanceDensity(std::vector<Edge2d>()) {}

AppearanceDensity::AppearanceDensity(const std::vector<Edge2d>& edges) {
  densities_.fill(0);
  double total = 0;
  for (const Edge2d& edge : edges) {
    if (!(edge.sharpness > 0)) continue;
    for (const auto& [bin, weight] : BinsOf(edge)) densities_[bin] += weight;
    total += 1;
  }
  const double uniform = 1.0 / static_cast<double>(densities_.size());
  for (double& density : densities_) {
    const double share = total > 0 ? density / total : uniform;
    // Either side may be the brighter one.
    density = (kShareOfUnlike * uniform + (1 - kShareOfUnlike) * share) /
              (2 * kBinWidth * kBinWidth);
  }
}

std::optional<Appearance> AppearanceDensity::AppearanceOf(
    const Edge2d& edge, const Eigen::Vector2d& direction) const {
  auto appearance = AppearanceAlong(edge);
  if (!appearance) return std::nullopt;
  if (TangentAt(edge.angle).dot(direction) < 0) appearance->SwapSides();
  double density = 0;
  for (const auto& [bin, weight] : BinsOf(edge)) {
    density += weight * densities_[bin];
  }
  appearance->density = static_cast<float>(density);
  return appearance;
}

std::array<AppearanceDensity::WeightedBin, 4> AppearanceDensity::BinsOf(
    const Edge2d& edge) {
  const auto [level, next_level] =
      BinsAround(static_cast<double>(edge.level), kNumLevels);
  const auto [contrast, next_contrast] =
      BinsAround(HalfContrast(edge), kNumContrasts);
  const auto bin = [](const WeightedBin& row, const WeightedBin& column) {
    return WeightedBin{row.index * kNumContrasts + column.index,
                       row.weight * column.weight};
  };
  return {bin(level, contrast),
          bin(level, next_contrast),
          bin(next_level, contrast),
          bin(next_level, next_contrast)};
}

// The bins with the nearest centres.
std::pair<AppearanceDensity::WeightedBin, AppearanceDensity::WeightedBin>
AppearanceDensity::BinsAround(double grey_levels, std::size_t num_bins) {
  const double place = std::clamp(
      grey_levels / kBinWidth - 0.5, 0.0, static_cast<double>(num_bins - 1));
  const auto bin = static_cast<std::size_t>(place);
  const double after = place - static_cast<double>(bin);
  return {{bin, 1 - after}, {std::min(bin + 1, num_bins - 1), after}};
}

namespace {

constexpr double kSeenAndDetected = 0.9;  // q
// Standard deviation of third-order orientations.
constexpr double kAngleSigmaRad = DegToRad(2);
// Directions within 15 degrees count as like: the range of chance angles.
constexpr double kAngleRangeRad = DegToRad(30);

// Of the prior that an edge looks unlike those of neighbouring views, among
// their weights.
constexpr double kWeightOfUnlike = 0.5;

// A normal density of which a sixth is three times as wide: shading, blur and
// nearby contours move some edges by more than noise does.
double WideTailedNormal(double x, double sigma) {
  const double z2 = (x / sigma) * (x / sigma);
  return (5.0 / 6 * std::exp(-z2 / 2) + 1.0 / 18 * std::exp(-z2 / 18)) /
         (sigma * std::sqrt(2 * kPi));
}

}  // namespace

Vote VoteWithSupport(const SupportFit& fit, double density) {
  const double real = kSeenAndDetected *
                      WideTailedNormal(fit.distance_px, fit.sigma_px) *
                      WideTailedNormal(fit.angle_rad, kAngleSigmaRad);
  const double chance = density / kAngleRangeRad;
  return {real / chance};
}

Vote VoteWithoutSupport() { return {}; }

double LogLikelihoodRatio(const Vote& vote) {
  return std::log(vote.position_ratio + 1 - kSeenAndDetected);
}

double AppearanceRatio(const Vote& vote,
                       const Votes& votes,
                       const std::vector<ViewNeighbor>& neighbors) {
  if (!vote.appearance) return 1;
  double sum = kWeightOfUnlike;
  double weights = kWeightOfUnlike;
  for (const ViewNeighbor& neighbor : neighbors) {
    const auto& other = votes[static_cast<std::size_t>(neighbor.view_idx)];
    if (!other || !other->appearance) continue;
    sum +=
        neighbor.weight * LikelihoodRatio(*vote.appearance, *other->appearance);
    weights += neighbor.weight;
  }
  return sum / weights;
}

double Evidence(const Votes& votes, const NeighborsByView& neighbors) {
  std::vector<double> logs(votes.size());
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (!votes[i]) continue;
    logs[i] =
        LogLikelihoodRatio({votes[i]->position_ratio *
                            AppearanceRatio(*votes[i], votes, neighbors[i])});
  }
  double evidence = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (!votes[i]) continue;
    double sum = logs[i];
    double weights = 1;
    for (const ViewNeighbor& neighbor : neighbors[i]) {
      const auto j = static_cast<std::size_t>(neighbor.view_idx);
      if (!votes[j]) continue;
      sum += neighbor.weight * logs[j];
      weights += neighbor.weight;
    }
    if (sum > 0) evidence += sum / weights;
  }
  return evidence;
}

std::vector<std::size_t> ByFallingEvidence(const std::vector<Edge3d>& edges) {
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    // Ties must not depend on the last bits of sums.
    const double rounded = std::round(1e6 * edges[i].evidence);
    const Eigen::Vector3d& x = edges[i].position;
    return std::tuple(-rounded, x.x(), x.y(), x.z());
  });
  return order;
}

}  // namespace curvix
