// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/smooth_curves.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "curve_refinement/curve_ends.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

constexpr std::size_t kMinNumSmoothedSamples = 5;

// One sample seen from the one that moves: signed arc length and position.
struct Neighbor {
  double along = 0;
  double weight = 0;
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
    if (neighbors.size() < kMinNumSmoothedSamples) return result;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d right = Eigen::Matrix3d::Zero();
    for (const Neighbor& n : neighbors) {
      const Eigen::Vector3d powers = n.Powers();
      normal += n.weight * powers * powers.transpose();
      right += n.weight * powers * (n.position - result.position).transpose();
    }
    // Rows: offset, first and half the second derivative.
    const Eigen::Matrix3d parabola = normal.ldlt().solve(right);
    if (!parabola.allFinite() || !(parabola.row(1).norm() > 0)) return result;
    result.position += parabola.row(0).transpose();
    result.tangent = parabola.row(1).transpose().normalized();
    return result;
  }

 private:
  std::vector<Neighbor> Neighbors(std::size_t i) const {
    std::vector<Neighbor> neighbors;
    for (const SampleAround& near :
         SamplesAround(curve_, i, kKernelReach * bandwidth_)) {
      neighbors.push_back(Weighted(near));
    }
    return neighbors;
  }

  Neighbor Weighted(const SampleAround& near) const {
    const CurveSample& sample = curve_.samples[near.index];
    const double r = near.along / bandwidth_;
    double weight = std::exp(-0.5 * r * r);
    // Relative to the bandwidth, so that weights do not depend on the scale.
    if (sample.sigma > 0) {
      const double precision = bandwidth_ / sample.sigma;
      weight *= precision * precision;
    }
    return {r, weight, sample.position};
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
