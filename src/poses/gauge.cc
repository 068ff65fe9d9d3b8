// SPDX-License-Identifier: BSD-3-Clause
#include "poses/gauge.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/median.h"
#include "geometry/directions.h"
#include "geometry/lens.h"

namespace curvix {
namespace {

constexpr int kNumGaugeIterations = 10;
constexpr double kMinLossScalePx = 0.05;

using Matrix7d = Eigen::Matrix<double, 7, 7>;
using Vector7d = Eigen::Matrix<double, 7, 1>;

// Scale of the weights, from the distances: outliers have little weight.
double LossScale(const std::vector<PosedView>& views,
                 const std::vector<SeenPlace>& places,
                 const Similarity3& transform) {
  std::vector<double> distances;
  for (const SeenPlace& place : places) {
    const PosedView& view = views[place.view_idx];
    const Eigen::Vector3d x = view.InCamera(transform * place.position);
    if (x.z() > 0) distances.push_back((view.Pixel(x) - place.pixel).norm());
  }
  return std::max(kMinLossScalePx, MedianOr(0, std::move(distances)));
}

}  // namespace

Similarity3 FixGauge(const std::vector<PosedView>& views,
                     const std::vector<SeenPlace>& places) {
  Similarity3 transform;
  std::vector<Eigen::Vector3d> positions;
  for (const SeenPlace& place : places) positions.push_back(place.position);
  // Not the mean: rays that are nearly parallel meet anywhere.
  const Eigen::Vector3d middle = MedianPosition(positions);
  for (int i = 0; i < kNumGaugeIterations; ++i) {
    const Eigen::Vector3d center = transform * middle;
    const double loss_scale_px = LossScale(views, places, transform);
    // Unknowns: a turn about the center, a shift and the change of the
    // logarithm of the scale, all small.
    Matrix7d matrix = Matrix7d::Zero();
    Vector7d vector = Vector7d::Zero();
    for (const SeenPlace& place : places) {
      const PosedView& view = views[place.view_idx];
      const Eigen::Vector3d position = transform * place.position;
      const Eigen::Vector3d x = view.InCamera(position);
      if (!(x.z() > 0)) continue;
      const Eigen::Vector2d residual = view.Pixel(x) - place.pixel;
      const Eigen::Matrix<double, 2, 3> by_position =
          PixelJacobian(view.calibration.topLeftCorner<2, 2>(), x) *
          view.rotation;
      const Eigen::Vector3d arm = position - center;
      Eigen::Matrix<double, 2, 7> jacobian;
      jacobian << -by_position * CrossMatrix(arm), by_position,
          by_position * arm;
      const double weight =
          1 / (1 + residual.squaredNorm() / (loss_scale_px * loss_scale_px));
      matrix += weight * jacobian.transpose() * jacobian;
      vector += weight * jacobian.transpose() * residual;
    }
    const Vector7d step = -matrix.ldlt().solve(vector);
    if (!step.allFinite()) return transform;
    const Eigen::Quaterniond turn = RotationBy(step.head<3>());
    const double growth = std::exp(step(6));
    transform.translation = center + step.segment<3>(3) +
                            growth * (turn * (transform.translation - center));
    transform.rotation = turn * transform.rotation;
    transform.scale *= growth;
  }
  return transform;
}

}  // namespace curvix
