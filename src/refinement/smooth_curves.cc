// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/smooth_curves.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

constexpr std::size_t kMinNumSamples = 5;
constexpr double kReachSigmas = 3;

// One sample seen from the one that moves: signed arc length and position.
struct Neighbor {
  double along = 0;
  double weight = 0;
  double sigma = 0;
  Eigen::Vector3d position;

  Eigen::Vector3d Powers() const { return {1, along, along * along}; }
};

class Smoother {
 public:
  Smoother(const Curve& curve, double bandwidth)
      : curve_(curve), bandwidth_(bandwidth) {}

  CurveSample Smooth(std::size_t i) const {
    const std::vector<Neighbor> neighbors = Neighbors(i);
    CurveSample result = curve_.samples[i];
    if (neighbors.size() < kMinNumSamples) return result;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d right = Eigen::Matrix3d::Zero();
    for (const Neighbor& n : neighbors) {
      const Eigen::Vector3d powers = n.Powers();
      normal += n.weight * powers * powers.transpose();
      right += n.weight * powers * (n.position - result.position).transpose();
    }
    // Rows: offset, first and half the second derivative.
    const auto factors = normal.ldlt();
    const Eigen::Matrix3d parabola = factors.solve(right);
    if (!parabola.allFinite() || !(parabola.row(1).norm() > 0)) return result;
    const Eigen::Vector3d influence = factors.solve(Eigen::Vector3d::UnitX());
    result.sigma = Sigma(neighbors, influence, parabola, result);
    result.position += parabola.row(0).transpose();
    result.tangent = parabola.row(1).transpose().normalized();
    return result;
  }

 private:
  // Standard deviation of the fitted offset: that of a weighted mean of
  // independent samples, more if they scatter more than their sigmas say.
  static double Sigma(const std::vector<Neighbor>& neighbors,
                      const Eigen::Vector3d& influence,
                      const Eigen::Matrix3d& parabola,
                      const CurveSample& sample) {
    double variance = 0, squares = 0, weights = 0;
    for (const Neighbor& n : neighbors) {
      if (!(n.sigma > 0)) return sample.sigma;
      const Eigen::Vector3d powers = n.Powers();
      const double share = n.weight * influence.dot(powers) * n.sigma;
      variance += share * share;
      const Eigen::Vector3d residual =
          n.position - sample.position - parabola.transpose() * powers;
      squares += n.weight * residual.squaredNorm() / (2 * n.sigma * n.sigma);
      weights += n.weight;
    }
    return std::sqrt(variance * std::max(1.0, squares / weights));
  }

  std::vector<Neighbor> Neighbors(std::size_t i) const {
    std::vector<Neighbor> neighbors;
    Add(i, 0, neighbors);
    Walk(i, 1, neighbors);
    Walk(i, -1, neighbors);
    return neighbors;
  }

  // From sample i on, in either direction, as far as the weights reach, and at
  // most half-way round a closed curve.
  void Walk(std::size_t i,
            int direction,
            std::vector<Neighbor>& neighbors) const {
    const std::size_t size = curve_.samples.size();
    const std::size_t last = direction > 0 ? size - 1 : 0;
    std::size_t steps = curve_.closed ? (size - 1) / 2 : size;
    double along = 0;
    for (std::size_t here = i; steps > 0; --steps) {
      if (!curve_.closed && here == last) return;
      const std::size_t next =
          direction > 0 ? (here + 1) % size : (here + size - 1) % size;
      along += (curve_.samples[next].position - curve_.samples[here].position)
                   .norm();
      if (along > kReachSigmas * bandwidth_) return;
      Add(next, direction * along, neighbors);
      here = next;
    }
  }

  void Add(std::size_t j,
           double along,
           std::vector<Neighbor>& neighbors) const {
    const CurveSample& sample = curve_.samples[j];
    const double r = along / bandwidth_;
    double weight = std::exp(-0.5 * r * r);
    // Relative to the bandwidth, so that weights do not depend on the scale.
    if (sample.sigma > 0) {
      const double precision = bandwidth_ / sample.sigma;
      weight *= precision * precision;
    }
    neighbors.push_back(
        {along / bandwidth_, weight, sample.sigma, sample.position});
  }

  const Curve& curve_;
  double bandwidth_;  // world units
};

Curve SmoothCurve(const Curve& curve,
                  const std::vector<PosedView>& views,
                  double smoothing_px) {
  Curve result = curve;
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const CurveSample& sample = curve.samples[i];
    const double pixel = PixelSize(sample.position, sample.support, views);
    if (!(pixel > 0)) continue;
    result.samples[i] = Smoother(curve, smoothing_px * pixel).Smooth(i);
  }
  return result;
}

}  // namespace

std::vector<Curve> SmoothCurves(const std::vector<Curve>& curves,
                                const std::vector<PosedView>& views,
                                const CurveRefinementOptions& options,
                                int num_threads) {
  if (!(options.smoothing_px > 0)) return curves;
  std::vector<Curve> smooth(curves.size());
  ParallelFor(curves.size(), num_threads, [&](std::size_t i) {
    smooth[i] = SmoothCurve(curves[i], views, options.smoothing_px);
  });
  return smooth;
}

}  // namespace curvix
