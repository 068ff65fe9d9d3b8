// SPDX-License-Identifier: BSD-3-Clause
#include "poses/gauge.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "base/median.h"
#include "geometry/directions.h"
#include "geometry/lens.h"

namespace curvix {
namespace {

constexpr int kNumGaugeIterations = 20;
constexpr double kMinLossScalePx = 0.05;

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix26d = Eigen::Matrix<double, 2, 6>;

struct NormalEquations {
  Matrix6d matrix = Matrix6d::Zero();
  Vector6d vector = Vector6d::Zero();
};

// How far `view` sees `position` from `pixel`, if it is in front.
std::optional<double> DistanceSeen(const PosedView& view,
                                   const Eigen::Vector3d& position,
                                   const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d x = view.InCamera(position);
  if (!(x.z() > 0)) return std::nullopt;
  return (view.Pixel(x) - pixel).norm();
}

// Scale of the weights, from the distances: outliers have little weight.
double LossScale(const std::vector<PosedView>& views,
                 const std::vector<SeenPlace>& places,
                 const Rigid3& transform) {
  std::vector<double> distances;
  for (const SeenPlace& place : places) {
    const auto distance = DistanceSeen(
        views[place.view_idx], transform * place.position, place.pixel);
    if (distance) distances.push_back(*distance);
  }
  return std::max(kMinLossScalePx, MedianOr(0, std::move(distances)));
}

// Unknowns: a turn about `center` of the places, then a shift, both small.
void Add(const PosedView& view,
         const Eigen::Vector3d& position,
         const Eigen::Vector3d& center,
         const Eigen::Vector2d& pixel,
         double loss_scale_px,
         NormalEquations* sum) {
  const Eigen::Vector3d x = view.InCamera(position);
  if (!(x.z() > 0)) return;
  const Eigen::Vector2d residual = view.Pixel(x) - pixel;
  const Eigen::Matrix<double, 2, 3> by_position =
      PixelJacobian(view.calibration.topLeftCorner<2, 2>(), x) * view.rotation;
  Matrix26d by_pose;
  by_pose.leftCols<3>() = -by_position * CrossMatrix(position - center);
  by_pose.rightCols<3>() = by_position;
  const double weight =
      1 / (1 + residual.squaredNorm() / (loss_scale_px * loss_scale_px));
  sum->matrix += weight * by_pose.transpose() * by_pose;
  sum->vector += weight * by_pose.transpose() * residual;
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
    NormalEquations sum;
    for (const SeenPlace& place : places) {
      Add(views[place.view_idx],
          transform * place.position,
          center,
          place.pixel,
          loss_scale_px,
          &sum);
    }
    const Vector6d step = -sum.matrix.ldlt().solve(sum.vector);
    if (!step.allFinite()) return transform;
    Rigid3 update;
    update.rotation = RotationBy(step.head<3>());
    update.translation = center + step.tail<3>() - update.rotation * center;
    transform = update * transform;
  }
  return transform;
}

}  // namespace curvix
