// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves without the scatter of their samples.
#include "curve_refinement/refine_curves.h"

#include <Eigen/Dense>
#include <cmath>

#include "base/parallel.h"
#include "curve_refinement/curve_ends.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

constexpr std::size_t kMinNumSmoothedSamples = 5;

// The sample at the parabola through its neighbours, by arc length from it;
// `bandwidth` in world units.
CurveSample Smoothed(const Curve& curve, std::size_t i, double bandwidth) {
  CurveSample result = curve.samples[i];
  const std::vector<SampleAround> neighbors =
      SamplesAround(curve, i, kKernelReach * bandwidth);
  if (neighbors.size() < kMinNumSmoothedSamples) return result;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d right = Eigen::Matrix3d::Zero();
  for (const SampleAround& near : neighbors) {
    const CurveSample& sample = curve.samples[near.index];
    const double r = near.along / bandwidth;
    double weight = std::exp(-0.5 * r * r);
    // Relative to the bandwidth, so that weights do not depend on the scale.
    if (sample.sigma > 0) {
      const double precision = bandwidth / sample.sigma;
      weight *= precision * precision;
    }
    const Eigen::Vector3d powers(1, r, r * r);
    normal += weight * powers * powers.transpose();
    right += weight * powers * (sample.position - result.position).transpose();
  }
  // Rows: offset, first and half the second derivative.
  const Eigen::Matrix3d parabola = normal.ldlt().solve(right);
  if (!parabola.allFinite() || !(parabola.row(1).norm() > 0)) return result;
  result.position += parabola.row(0).transpose();
  result.tangent = parabola.row(1).transpose().normalized();
  return result;
}

Curve SmoothCurve(const Curve& curve, const RefinementInput& input) {
  Curve result = curve;
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const CurveSample& sample = curve.samples[i];
    const double pixel = PixelSize(sample, input.views);
    if (!(pixel > 0)) continue;
    result.samples[i] = Smoothed(curve, i, input.options.smoothing_px * pixel);
  }
  return result;
}

}  // namespace

std::vector<Curve> SmoothCurves(const std::vector<Curve>& curves,
                                const RefinementInput& input) {
  if (!(input.options.smoothing_px > 0)) return curves;
  std::vector<Curve> smooth(curves.size());
  ParallelFor(curves.size(), input.num_threads, [&](std::size_t i) {
    smooth[i] = SmoothCurve(curves[i], input);
  });
  return smooth;
}

}  // namespace curvix
