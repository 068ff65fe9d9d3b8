// SPDX-License-Identifier: BSD-3-Clause
#include "poses/gauge.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>

#include "base/median.h"
#include "geometry/directions.h"
#include "geometry/lens.h"

namespace curvix {
namespace {

constexpr int kNumGaugeIterations = 10;
constexpr double kMinLossScalePx = 0.05;

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

// Scale of the weights, from the distances: outliers have little weight.
double LossScale(const std::vector<PosedView>& views,
                 const std::vector<SeenPlace>& places,
                 const Rigid3& transform) {
  std::vector<double> distances;
  for (const SeenPlace& place : places) {
    const PosedView& view = views[place.view_idx];
    const Eigen::Vector3d x = view.InCamera(transform * place.position);
    if (x.z() > 0) distances.push_back((view.Pixel(x) - place.pixel).norm());
  }
  return std::max(kMinLossScalePx, MedianOr(0, std::move(distances)));
}

}  // namespace

Rigid3 FixGauge(const std::vector<PosedView>& views,
                const std::vector<SeenPlace>& places) {
  Rigid3 transform;
  std::vector<Eigen::Vector3d> positions;
  for (const SeenPlace& place : places) positions.push_back(place.position);
  // Not the mean: rays that are nearly parallel meet anywhere.
  const Eigen::Vector3d middle = MedianPosition(positions);
  for (int i = 0; i < kNumGaugeIterations; ++i) {
    const Eigen::Vector3d center = transform * middle;
    const double loss_scale_px = LossScale(views, places, transform);
    // Unknowns: a turn about the center, then a shift, both small.
    Matrix6d matrix = Matrix6d::Zero();
    Vector6d vector = Vector6d::Zero();
    for (const SeenPlace& place : places) {
      const PosedView& view = views[place.view_idx];
      const Eigen::Vector3d position = transform * place.position;
      const Eigen::Vector3d x = view.InCamera(position);
      if (!(x.z() > 0)) continue;
      const Eigen::Vector2d residual = view.Pixel(x) - place.pixel;
      const Eigen::Matrix<double, 2, 3> by_position =
          PixelJacobian(view.calibration.topLeftCorner<2, 2>(), x) *
          view.rotation;
      Eigen::Matrix<double, 2, 6> by_pose;
      by_pose << -by_position * CrossMatrix(position - center), by_position;
      const double weight =
          1 / (1 + residual.squaredNorm() / (loss_scale_px * loss_scale_px));
      matrix += weight * by_pose.transpose() * by_pose;
      vector += weight * by_pose.transpose() * residual;
    }
    const Vector6d step = -matrix.ldlt().solve(vector);
    if (!step.allFinite()) return transform;
    Rigid3 update;
    update.rotation = RotationBy(step.head<3>());
    update.translation = center + step.tail<3>() - update.rotation * center;
    transform = update * transform;
  }
  return transform;
}

}  // namespace curvix
