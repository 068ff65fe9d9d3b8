// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). How well primitives fix the points where they end.
#include "fitting/end_covariance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace curvix {
namespace {

// Edges this near to each other share pixels, and so do those at a corner.
constexpr double kSharedPx = 4;

// A polynomial of p parameters that is fitted to n values has, at its ends, p^2
// / n of their variance. A line is one of two parameters in each direction
// across it, a conic nearly one of three.
double NumParametersAcross(const Shape& shape) {
  if (std::holds_alternative<FittedLine>(shape)) return 2;
  if (std::holds_alternative<Conic>(shape)) return 3;
  return static_cast<double>(std::get<Spline>(shape).control_points.size());
}

Eigen::Vector3d ChordAt(const FitSamples& samples, bool at_end) {
  const std::size_t last = samples.size() - 1;
  const Eigen::Vector3d chord =
      at_end ? samples[last].position - samples[last - 1].position
             : samples[1].position - samples[0].position;
  return chord.norm() > 0 ? chord.normalized() : Eigen::Vector3d::UnitX();
}

PrimitiveEnd EndOf(const Shape& shape, const FitSamples& samples, bool at_end) {
  const FitSample& sample = at_end ? samples.back() : samples.front();
  PrimitiveEnd end;
  const std::optional<Foot> foot = FootOn(shape, sample.position);
  end.is_shape = foot.has_value();
  end.foot = foot ? foot->position : sample.position;
  end.tangent = foot ? foot->tangent : ChordAt(samples, at_end);
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  double pixel = 0;
  for (const FitSample& s : samples) {
    mean += s.covariance;
    pixel += s.pixel;
  }
  const double n = static_cast<double>(samples.size());
  const double num_parameters = NumParametersAcross(shape);
  const double share =
      std::min(1.0, num_parameters * num_parameters / NumIndependent(samples));
  const Eigen::Matrix3d along = end.tangent * end.tangent.transpose();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along;
  // So that it has an inverse whatever the samples say.
  const double least = 1e-6 * mean.trace() / n;
  const double bend = std::max(kSharedPx * pixel / n, sample.sigma);
  end.covariance = share * (across * mean * across / n + least * across) +
                   bend * bend * along;
  end.common = SharedSigma(samples);
  return end;
}

}  // namespace

double NumIndependent(const FitSamples& samples) {
  double length = 0, pixel = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    pixel += samples[i].pixel;
    if (i == 0) continue;
    length += (samples[i].position - samples[i - 1].position).norm();
  }
  const double n = static_cast<double>(samples.size());
  pixel /= n;
  return pixel > 0 ? std::min(n, 1 + length / (kSharedPx * pixel)) : n;
}

std::optional<Foot> FootOn(const Shape& shape, const Eigen::Vector3d& point) {
  if (const auto* line = std::get_if<FittedLine>(&shape)) {
    return Foot{line->Closest(point), line->direction};
  }
  if (const auto* conic = std::get_if<Conic>(&shape)) {
    const double t = NearestParameter(*conic, point);
    return Foot{conic->At(t), conic->Tangent(t)};
  }
  return std::nullopt;
}

std::pair<PrimitiveEnd, PrimitiveEnd> EndsOf(const Shape& shape,
                                             const FitSamples& samples) {
  return {EndOf(shape, samples, false), EndOf(shape, samples, true)};
}

Eigen::Matrix3d MeetingCovariance(const std::vector<PrimitiveEnd>& ends,
                                  const Eigen::Vector3d& position) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double common = 0, missed = 0;
  int num_equations = -3;
  for (const PrimitiveEnd& end : ends) {
    const Eigen::Matrix3d own = end.covariance.inverse();
    information += own;
    common = std::max(common, end.common);
    if (!end.is_shape) continue;
    const Eigen::Vector3d offset = position - end.foot;
    const Eigen::Vector3d off = offset - end.tangent.dot(offset) * end.tangent;
    missed += off.dot(own * off);
    num_equations += 2;
  }
  const double factor =
      num_equations > 0 ? std::max(1.0, missed / num_equations) : 1;
  return factor * information.inverse() +
         common * common * Eigen::Matrix3d::Identity();
}

}  // namespace curvix
