// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_search_estimates.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/infinity.h"
#include "base/median.h"
#include "geometry/directions.h"
#include "geometry/lens.h"

namespace curvix {
namespace {

constexpr double kWidthPx = 0.4;  // of a vote
constexpr double kStepPx = 0.5;
constexpr double kFineStepPx = 0.125;
// A shift has to win this many times the votes of none, and more than chance
// gives the best of some hundred shifts: four standard deviations.
constexpr double kClearly = 1.15;
constexpr double kChanceDeviations = 4;

double NumVotes(const std::vector<EdgesAround>& samples,
                const Eigen::Vector2d& shift) {
  double votes = 0;
  for (const EdgesAround& sample : samples) {
    const double along = sample.normal.dot(shift);
    double least = 4 * kWidthPx;
    for (const double distance : sample.distances_px) {
      least = std::min(least, std::abs(along - distance));
    }
    const double z = least / kWidthPx;
    votes += std::exp(-0.5 * z * z);
  }
  return votes;
}

struct Best {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double votes = 0;
};

// The best of a square grid around best.shift, or best itself.
Best Search(const std::vector<EdgesAround>& samples,
            double reach_px,
            double step_px,
            Best best) {
  const Eigen::Vector2d center = best.shift;
  const int num_steps = static_cast<int>(std::floor(reach_px / step_px));
  for (int i = -num_steps; i <= num_steps; ++i) {
    for (int k = -num_steps; k <= num_steps; ++k) {
      const Eigen::Vector2d shift = center + step_px * Eigen::Vector2d(k, i);
      const double votes = NumVotes(samples, shift);
      if (votes > best.votes) best = {shift, votes};
    }
  }
  return best;
}

}  // namespace

Eigen::Vector2d FindShift(const std::vector<EdgesAround>& samples,
                          double reach_px) {
  const double votes_of_none = NumVotes(samples, Eigen::Vector2d::Zero());
  const double asked = kClearly * votes_of_none +
                       kChanceDeviations * std::sqrt(votes_of_none + 1);
  // Most samples fit as they are: no shift can win so many votes.
  if (static_cast<double>(samples.size()) <= asked) return {0, 0};
  Best best = Search(samples, reach_px, kStepPx, {});
  best = Search(samples, kStepPx, kFineStepPx, best);
  return best.votes > asked ? best.shift : Eigen::Vector2d(0, 0);
}

namespace {

constexpr int kNumIterations = 30;
constexpr double kLeastSpreadPx = 0.05;
constexpr double kNarrowPx = 0.3;
// Samples follow each other along curves, so chance makes narrow peaks.
constexpr double kLeastNarrowShare = 0.4;

struct Mixture {
  double spread_px = 1;
  double share = 0.5;  // of the half-normal density
  double log_likelihood = 0;
};

// One step of expectation maximisation; the likelihood is that of `before`.
Mixture Improve(const Mixture& before,
                const std::vector<double>& distances_px,
                double gate_px) {
  constexpr double kPeak = 0.7978845608028654;  // sqrt(2 / pi)
  Mixture after;
  double weights = 0, squares = 0;
  for (const double distance : distances_px) {
    const double z = distance / before.spread_px;
    const double own =
        before.share * kPeak / before.spread_px * std::exp(-0.5 * z * z);
    const double chance = (1 - before.share) / gate_px;
    const double weight = own / (own + chance);
    weights += weight;
    squares += weight * distance * distance;
    after.log_likelihood += std::log(own + chance);
  }
  after.spread_px = std::max(
      kLeastSpreadPx,
      std::sqrt(squares /
                std::max(weights, std::numeric_limits<double>::min())));
  after.share =
      std::min(0.99, weights / static_cast<double>(distances_px.size()));
  return after;
}

}  // namespace

double FitSpread(const std::vector<double>& distances_px, double gate_px) {
  Mixture best;
  best.log_likelihood = -kInfinity;
  for (const double start_px : std::array{1.2, 0.4, 0.1}) {
    Mixture mixture{start_px, 0.5, 0};
    for (int i = 0; i < kNumIterations; ++i) {
      mixture = Improve(mixture, distances_px, gate_px);
    }
    if (mixture.spread_px < kNarrowPx && mixture.share < kLeastNarrowShare) {
      continue;
    }
    if (mixture.log_likelihood > best.log_likelihood) best = mixture;
  }
  return best.spread_px;
}

namespace {

constexpr int kNumGaugeIterations = 10;
constexpr double kMinLossScalePx = 0.05;

using Matrix7d = Eigen::Matrix<double, 7, 7>;
using Vector7d = Eigen::Matrix<double, 7, 1>;

// Scale of the weights, from the distances: outliers have little weight.
double LossScale(const std::vector<PosedView>& views,
                 const std::vector<SeenPlace>& places,
                 const Similarity3& transform) {
  std::vector<double> distances;
  for (const SeenPlace& place : places) {
    const PosedView& view = views[place.view_idx];
    const Eigen::Vector3d x = view.InCamera(transform * place.position);
    if (x.z() > 0) distances.push_back((view.Pixel(x) - place.pixel).norm());
  }
  return std::max(kMinLossScalePx, MedianOr(0, std::move(distances)));
}

}  // namespace

Similarity3 FixGauge(const std::vector<PosedView>& views,
                     const std::vector<SeenPlace>& places) {
  Similarity3 transform;
  std::vector<Eigen::Vector3d> positions;
  for (const SeenPlace& place : places) positions.push_back(place.position);
  // Not the mean: rays that are nearly parallel meet anywhere.
  const Eigen::Vector3d middle = MedianPosition(positions);
  for (int i = 0; i < kNumGaugeIterations; ++i) {
    const Eigen::Vector3d center = transform * middle;
    const double loss_scale_px = LossScale(views, places, transform);
    // Unknowns: a turn about the center, a shift and the change of the
    // logarithm of the scale, all small.
    Matrix7d matrix = Matrix7d::Zero();
    Vector7d vector = Vector7d::Zero();
    for (const SeenPlace& place : places) {
      const PosedView& view = views[place.view_idx];
      const Eigen::Vector3d position = transform * place.position;
      const Eigen::Vector3d x = view.InCamera(position);
      if (!(x.z() > 0)) continue;
      const Eigen::Vector2d residual = view.Pixel(x) - place.pixel;
      const Eigen::Matrix<double, 2, 3> by_position =
          PixelJacobian(view.calibration.topLeftCorner<2, 2>(), x) *
          view.rotation;
      const Eigen::Vector3d arm = position - center;
      Eigen::Matrix<double, 2, 7> jacobian;
      jacobian << -by_position * CrossMatrix(arm), by_position,
          by_position * arm;
      const double weight =
          1 / (1 + residual.squaredNorm() / (loss_scale_px * loss_scale_px));
      matrix += weight * jacobian.transpose() * jacobian;
      vector += weight * jacobian.transpose() * residual;
    }
    const Vector7d step = -matrix.ldlt().solve(vector);
    if (!step.allFinite()) return transform;
    const Eigen::Quaterniond turn = RotationBy(step.head<3>());
    const double growth = std::exp(step(6));
    transform.translation = center + step.segment<3>(3) +
                            growth * (turn * (transform.translation - center));
    transform.rotation = turn * transform.rotation;
    transform.scale *= growth;
  }
  return transform;
}

}  // namespace curvix
