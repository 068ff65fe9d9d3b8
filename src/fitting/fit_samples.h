// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What primitives are fitted to.
#pragma once

#include <curvix/curves.h>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

struct FitSample {
  Eigen::Vector3d position;
  double sigma = 0;   // > 0
  double common = 0;  // of it, what all samples of a curve share; >= 0
  double pixel = 0;   // how long a pixel is there; 0: not known
  // Its errors, across the curve; the common ones included.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  CurveKind kind = CurveKind::kUnknown;
};

// A curve or a part of one, in order; and a view of it.
using FitSamples = std::vector<FitSample>;
using FitSpan = std::span<const FitSample>;

// Of a curve of two samples or more, with the standard deviations that
// FitCurves describes.
FitSamples MakeSamples(const Curve& curve, const std::vector<PosedView>& views);

// Standard deviation of a bent primitive from what its samples share, which
// does not fall with their number: a circle whose edges all lie inside is too
// small.
inline double SharedSigma(const FitSamples& samples) {
  double sum = 0;
  for (const FitSample& s : samples) sum += s.common;
  return sum / static_cast<double>(samples.size());
}

// From here on, in standard deviations, a sample is an outlier.
constexpr double kOutlierSigmas = 3;

// Of every sample, as if none were an outlier.
inline std::vector<double> EqualWeights(FitSpan samples) {
  std::vector<double> weights;
  weights.reserve(samples.size());
  for (const FitSample& s : samples) weights.push_back(1 / (s.sigma * s.sigma));
  return weights;
}

// Of samples with weights.
struct MeanAndScatter {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  // About the mean; only the lower triangle, which eigensolvers read.
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
};

inline MeanAndScatter WeightedScatter(FitSpan samples,
                                      const std::vector<double>& weights) {
  MeanAndScatter result;
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum += weights[i];
    result.mean += weights[i] * samples[i].position;
  }
  result.mean /= sum;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3d offset = samples[i].position - result.mean;
    for (int row = 0; row < 3; ++row) {
      for (int col = 0; col <= row; ++col) {
        result.scatter(row, col) += weights[i] * offset(row) * offset(col);
      }
    }
  }
  return result;
}

// Rounds of reweighting in which the limit for outliers comes down to
// kOutlierSigmas, so that a first fit that outliers have pulled away finds
// back.
constexpr int kNumRounds = 8;

// Weight of a sample in round 0, 1, ..., kNumRounds - 1.
inline double RobustWeight(double squared_distance, double sigma, int round) {
  const int doublings = std::max(0, kNumRounds - 3 - round);
  const double scale = kOutlierSigmas * sigma * (1 << doublings);
  const double ratio = 1 + squared_distance / (scale * scale);
  return 1 / (sigma * sigma * ratio * ratio);
}

}  // namespace curvix
