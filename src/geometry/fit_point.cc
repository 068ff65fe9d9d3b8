// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/fit_point.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/infinity.h"
#include "base/median.h"
#include "geometry/lens.h"

namespace curvix {
namespace {

// The sum of Cauchy's loss; infinite where a camera has no image.
double Cost(const Eigen::Vector3d& position,
            const std::vector<PointInImage>& seen) {
  double sum = 0;
  for (const PointInImage& at : seen) {
    const auto pixel = Project(*at.camera, at.cam_from_world, position);
    if (!pixel) return kInfinity;
    sum += std::log1p((*pixel - at.pixel).squaredNorm());
  }
  return sum;
}

// The Gauss-Newton step; zero where there is none.
Eigen::Vector3d Step(const Eigen::Vector3d& position,
                     const std::vector<PointInImage>& seen) {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const PointInImage& at : seen) {
    const auto pixel = Project(*at.camera, at.cam_from_world, position);
    if (!pixel) continue;
    const Eigen::Matrix<double, 2, 3> jacobian =
        PixelJacobian(*at.camera, at.cam_from_world * position) *
        at.cam_from_world.rotation.toRotationMatrix();
    const Eigen::Vector2d residual = at.pixel - *pixel;
    const double weight = 1 / (1 + residual.squaredNorm());
    hessian += weight * jacobian.transpose() * jacobian;
    gradient += weight * jacobian.transpose() * residual;
  }
  const Eigen::Vector3d step = hessian.ldlt().solve(gradient);
  return step.allFinite() ? step : Eigen::Vector3d::Zero();
}

}  // namespace

Eigen::Vector3d FitPoint(const Eigen::Vector3d& start,
                         const std::vector<PointInImage>& seen) {
  constexpr int kMaxNumSteps = 20;
  constexpr int kMaxNumHalvings = 8;
  constexpr double kMinGain = 1e-6;  // of the cost
  Eigen::Vector3d best = start;
  double cost = Cost(best, seen);
  for (int i = 0; i < kMaxNumSteps; ++i) {
    Eigen::Vector3d step = Step(best, seen);
    const double previous = cost;
    for (int k = 0; k < kMaxNumHalvings && cost == previous; ++k, step /= 2) {
      const double trial_cost = Cost(best + step, seen);
      if (!(trial_cost < cost)) continue;
      cost = trial_cost;
      best += step;
    }
    if (!(cost < previous * (1 - kMinGain))) break;
  }
  return best;
}

bool PointsFit(std::vector<std::vector<double>> errors_by_view) {
  return std::ranges::all_of(errors_by_view, [](std::vector<double>& of_view) {
    return MedianOr(kInfinity, std::move(of_view)) < kGoodPoseErrorPx;
  });
}

}  // namespace curvix
