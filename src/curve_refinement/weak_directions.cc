// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/weak_directions.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/angles.h"
#include "geometry/directions.h"

namespace curvix {
namespace {

constexpr std::size_t kReach = 6;  // samples
constexpr double kMinRatio = 2;
constexpr double kMaxTurnDeg = 10;
constexpr double kMinEigenvalue = 1e-6;  // of the larger one

// Indices of the samples up to kReach before and behind sample k.
std::vector<std::size_t> WindowAround(const Curve& curve, std::size_t k) {
  const std::size_t size = curve.samples.size();
  std::vector<std::size_t> window;
  for (std::size_t i = 0; i <= 2 * kReach; ++i) {
    const std::size_t sample = k + i + size - kReach;
    if (curve.closed) {
      window.push_back(sample % size);
    } else if (sample >= size && sample < 2 * size) {
      window.push_back(sample - size);
    }
  }
  return window;
}

// The angle between the outermost tangents in the plane of `along` and
// `across`.
double TurnInPlane(const Curve& curve,
                   const std::vector<std::size_t>& window,
                   const Eigen::Vector3d& along,
                   const Eigen::Vector3d& across) {
  double least = 0;
  double most = 0;
  for (const std::size_t k : window) {
    const Eigen::Vector3d& tangent = curve.samples[k].tangent;
    const double angle = std::atan2(tangent.dot(across), tangent.dot(along));
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  return most - least;
}

std::optional<WeakDirection> WeakDirectionAround(
    const Curve& curve,
    std::size_t k,
    const std::vector<Eigen::Matrix3d>& information) {
  const std::vector<std::size_t> window = WindowAround(curve, k);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (const std::size_t i : window) {
    sum += information[i];
    along += curve.samples[i].tangent;
  }
  if (!(along.norm() > 0)) return std::nullopt;
  along.normalize();
  const AcrossAxes axes = AxesAcross(along);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(axes.transpose() * sum * axes);
  const double most = solver.eigenvalues()(1);
  if (!(most > 0)) return std::nullopt;
  const double least = std::max(solver.eigenvalues()(0), kMinEigenvalue * most);
  const WeakDirection weak{
      axes * solver.eigenvectors().col(0), along, std::sqrt(most / least)};
  if (weak.ratio < kMinRatio ||
      TurnInPlane(curve, window, along, along.cross(weak.direction)) >
          DegToRad(kMaxTurnDeg)) {
    return std::nullopt;
  }
  return weak;
}

}  // namespace

std::vector<std::optional<WeakDirection>> WeakDirections(
    const Curve& curve, const std::vector<Eigen::Matrix3d>& information) {
  std::vector<std::optional<WeakDirection>> directions(curve.samples.size());
  for (std::size_t k = 0; k < directions.size(); ++k) {
    directions[k] = WeakDirectionAround(curve, k, information);
  }
  return directions;
}

}  // namespace curvix
