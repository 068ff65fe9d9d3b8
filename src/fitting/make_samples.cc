// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Samples of curves and how well they are known.
#include "fitting/primitive.h"

#include <cmath>

#include "base/check.h"
#include "base/infinity.h"
#include "base/median.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

// Standard deviation of samples that come without: pixels of the view that sees
// the sample largest, and at most this share of the distance between samples.
constexpr double kUnknownSigmaPx = 1;
constexpr double kUnknownSigmaSteps = 0.05;
// Standard deviation of the error that neighbouring samples have in common, as
// of edges in blurred or bent images: added, in squares, to the sigma of each
// sample. Pixels of the view that sees the sample largest.
constexpr double kCommonErrorPx = 0.1;
// Next to a corner, edges are bent and ends were moved to meet others: pixels,
// and times the error that samples share elsewhere.
constexpr double kBentPx = 4;
constexpr double kBentFactor = 4;

// The median of the known sigmas; nullopt if none is known.
std::optional<double> UsualSigma(const Curve& curve) {
  std::vector<double> known;
  for (const CurveSample& s : curve.samples) {
    if (s.sigma > 0) known.push_back(s.sigma);
  }
  if (known.empty()) return std::nullopt;
  return Median(std::move(known));
}

double MeanStep(const Curve& curve) {
  return Length(curve) /
         static_cast<double>(curve.samples.size() - (curve.closed ? 0 : 1));
}

// Where none is known. `pixel`: 0 if no view sees the sample.
double AssumedSigma(double mean_step, double pixel) {
  double sigma = kUnknownSigmaSteps * mean_step;
  if (pixel > 0) sigma = std::min(sigma, kUnknownSigmaPx * pixel);
  return sigma > 0 ? sigma : 1;
}

// Of each sample, along the curve, to its nearer end; infinite if it is closed.
std::vector<double> DistancesToEnd(const Curve& curve) {
  const std::size_t n = curve.samples.size();
  std::vector<double> distances(n, kInfinity);
  if (curve.closed) return distances;
  const auto step = [&](std::size_t i) {
    return (curve.samples[i + 1].position - curve.samples[i].position).norm();
  };
  distances.front() = distances.back() = 0;
  for (std::size_t i = 1; i < n; ++i) {
    distances[i] = std::min(distances[i], distances[i - 1] + step(i - 1));
  }
  for (std::size_t i = n - 1; i-- > 0;) {
    distances[i] = std::min(distances[i], distances[i + 1] + step(i));
  }
  return distances;
}

}  // namespace

FitSamples MakeSamples(const Curve& curve,
                       const std::vector<PosedView>& views) {
  CURVIX_CHECK(curve.samples.size() >= 2, "a curve has two samples or more");
  FitSamples samples;
  const std::optional<double> usual = UsualSigma(curve);
  const double mean_step = MeanStep(curve);
  const std::vector<double> to_end = DistancesToEnd(curve);
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const CurveSample& s = curve.samples[i];
    const double pixel = PixelSize(s, views);
    const double common = kCommonErrorPx * pixel;
    const double bent = to_end[i] < kBentPx * pixel ? kBentFactor : 1;
    const double own =
        s.sigma > 0 ? s.sigma : usual.value_or(AssumedSigma(mean_step, pixel));
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - s.tangent * s.tangent.transpose();
    Eigen::Matrix3d covariance = common * common * across;
    covariance += s.covariance.isZero(0) ? Eigen::Matrix3d(own * own * across)
                                         : s.covariance;
    samples.push_back({s.position,
                       std::hypot(own, bent * common),
                       common,
                       pixel,
                       covariance,
                       s.kind});
  }
  return samples;
}

}  // namespace curvix
