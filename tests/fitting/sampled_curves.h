// SPDX-License-Identifier: BSD-3-Clause
// Curves with errors, and what they are made of.
#pragma once

#include <curvix/fitting.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/random.h"

namespace curvix {

inline constexpr double kSigma = 0.001;

// `n` samples of position(t), t from 0 to 1, with errors of kSigma.
inline Curve Sample(const std::function<Eigen::Vector3d(double)>& position,
                    int n,
                    bool closed = false,
                    double noise = kSigma) {
  Random random(7);
  Curve curve;
  curve.closed = closed;
  for (int i = 0; i < n; ++i) {
    CurveSample& sample = curve.samples.emplace_back();
    const double t = static_cast<double>(i) / (closed ? n : n - 1);
    sample.position = position(t) + noise * random.NormalVector();
    sample.sigma = kSigma;
  }
  return curve;
}

inline FittedCurves Fit(std::vector<Curve> curves, int num_threads = 1) {
  return FitCurves({std::move(curves)}, {}, {}, num_threads);
}

inline std::vector<std::string> Kinds(const FittedCurve& curve) {
  std::vector<std::string> kinds;
  for (const CurveFit& fit : curve.fits) kinds.emplace_back(KindName(fit));
  return kinds;
}

}  // namespace curvix
