// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/curve_arms.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "refinement/samples_around.h"

namespace curvix {

Curve ArmTo(const Curve& curve,
            std::size_t last,
            bool with_direction,
            const ArmStretch& stretch) {
  Curve arm;
  for (const SampleAround& around :
       SamplesAround(curve, last, stretch.skipped + stretch.length)) {
    const double away = with_direction ? -around.along : around.along;
    if (away < stretch.skipped) continue;
    CurveSample& sample = arm.samples.emplace_back(curve.samples[around.index]);
    if (!with_direction) sample.tangent = -sample.tangent;
  }
  std::reverse(arm.samples.begin(), arm.samples.end());
  return arm;
}

double DistanceFromParabola(const Curve& from, const Curve& to) {
  const Eigen::Vector3d origin = from.samples.back().position;
  const Eigen::Vector3d way = to.samples.back().position - origin;
  const auto num_samples =
      static_cast<Eigen::Index>(from.samples.size() + to.samples.size());
  Eigen::MatrixX3d powers(num_samples, 3);
  Eigen::MatrixX3d positions(num_samples, 3);
  Eigen::Index row = 0;
  for (const Curve* arm : {&from, &to}) {
    for (const CurveSample& sample : arm->samples) {
      const Eigen::Vector3d offset = sample.position - origin;
      const double t = offset.dot(way) / way.squaredNorm();
      powers.row(row) << 1, t, t * t;
      positions.row(row++) = offset;
    }
  }
  const Eigen::Matrix3d parabola =
      powers.colPivHouseholderQr().solve(positions);
  return std::sqrt((powers * parabola - positions).squaredNorm() /
                   static_cast<double>(num_samples));
}

}  // namespace curvix
