// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/end_covariance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFixedWeight = 1e4;  // times that of all samples

// A distance from the circle changes with three parameters by `row`.
struct Observation {
  Vector3d row;
  double weight = 0;
  double variance = 0;          // independent of the others
  Vector3d shared = {0, 0, 0};  // standard deviations, mode by mode
};

// Of the parameters that least squares gives. A sum of squares, so that no
// variance is below 0.
Matrix3d CovarianceOf(const std::vector<Observation>& observations) {
  Matrix3d information = Matrix3d::Zero();
  Matrix3d shared = Matrix3d::Zero();  // a column per mode
  for (const Observation& o : observations) {
    information += o.weight * o.row * o.row.transpose();
    shared += o.weight * o.row * o.shared.transpose();
  }
  const Matrix3d inverse = information.inverse();
  const Matrix3d moved = inverse * shared;
  Matrix3d covariance = moved * moved.transpose();
  for (const Observation& o : observations) {
    const Vector3d gain = o.weight * inverse * o.row;
    covariance += o.variance * gain * gain.transpose();
  }
  return covariance;
}

// The modes in which samples err together, at share x of the way along an arc,
// from -1 to 1, or at angle t.
Vector3d SharedModes(double x, double t, bool is_whole) {
  if (is_whole) return {1, std::cos(t), std::sin(t)};
  return {1, x, (3 * x * x - 1) / 2};
}

// The parameters of a circle, by which its arc moves: a shift out of the plane
// or outwards, a turn, and a bow, the last two measured where the arc ends. So
// they are as well known on an arc that is nearly straight, whose centre and
// radius hardly differ.
class ArcFrame {
 public:
  ArcFrame(const Conic& circle, double middle, double reach)
      : radius_(circle.a), middle_(middle), reach_(reach) {
    const double x = std::cos(middle), y = std::sin(middle);
    axes_ << circle.frame * Vector3d(x, y, 0),
        circle.frame * Vector3d(-y, x, 0), circle.frame.col(2);
  }

  Vector3d RowInPlane(double t) const {
    return {std::cos(t - middle_), Turn(t), Bow(t)};
  }
  Vector3d RowOffPlane(double t) const { return {1, -Turn(t), Bow(t)}; }
  Vector3d normal() const { return axes_.col(2); }

  // What centre, normal and radius in the world change by with the parameters
  // in the plane and those off it.
  Eigen::Matrix<double, 7, 6> ToWorld() const {
    const double turn = 1 / reach_, bow = 1 / (reach_ * reach_);
    Eigen::Matrix<double, 7, 6> world = Eigen::Matrix<double, 7, 6>::Zero();
    world.block<3, 1>(0, 0) = axes_.col(0);
    world.block<3, 1>(0, 1) = turn * axes_.col(1);
    world.block<3, 1>(0, 2) = -bow * axes_.col(0);
    world(6, 2) = bow;
    world.block<3, 1>(0, 3) = axes_.col(2);
    world.block<3, 1>(3, 4) = turn / radius_ * axes_.col(1);
    world.block<3, 1>(0, 5) = bow * axes_.col(2);
    world.block<3, 1>(3, 5) = bow / radius_ * axes_.col(0);
    return world;
  }

 private:
  double Turn(double t) const { return std::sin(t - middle_) / reach_; }
  double Bow(double t) const {
    const double sine = std::sin((t - middle_) / 2) / reach_;
    return 2 * sine * sine;
  }

  double radius_, middle_, reach_;
  Matrix3d axes_;  // outwards and along in the middle of the arc, normal
};

// The largest distance of an angle from `middle`.
double ReachOf(const std::vector<double>& angles, double middle) {
  double reach = 1e-9;
  for (const double t : angles) reach = std::max(reach, std::abs(t - middle));
  return reach;
}

// By how much the squared distances of the samples exceed what their sigmas
// say: 1 if these are right or too large.
double Excess(const Conic& circle, const FitSamples& samples) {
  const double free = 2 * static_cast<double>(samples.size()) - 6;
  const double cost = CostOf(SquaredDistances(circle, samples), samples);
  return std::max(1.0, cost / std::max(1.0, free));
}

// Edges this near to each other share pixels, and so do those at a corner.
constexpr double kSharedPx = 4;

// How many of the samples tell as much as if they erred independently: one in 4
// px.
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

}  // namespace

std::optional<SpaceEdge> FootOn(const Shape& shape,
                                const Eigen::Vector3d& point) {
  if (const auto* line = std::get_if<FittedLine>(&shape)) {
    return SpaceEdge{line->projection(point), line->direction()};
  }
  if (const auto* conic = std::get_if<Conic>(&shape)) {
    const double t = NearestParameter(*conic, point);
    return SpaceEdge{conic->At(t), conic->Tangent(t)};
  }
  return std::nullopt;
}

PrimitiveEnd EndOf(const Shape& shape, const FitSamples& samples, bool at_end) {
  const FitSample& sample = at_end ? samples.back() : samples.front();
  PrimitiveEnd end;
  end.sample = sample;
  const std::optional<SpaceEdge> foot = FootOn(shape, sample.position);
  end.fixes_node = foot.has_value();
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

Eigen::Matrix3d MeetingCovariance(const std::vector<PrimitiveEnd>& ends,
                                  const Eigen::Vector3d& position) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double common = 0, missed = 0;
  int num_equations = -3;
  for (const PrimitiveEnd& end : ends) {
    const Eigen::Matrix3d own = end.covariance.inverse();
    information += own;
    common = std::max(common, end.common);
    if (!end.fixes_node) continue;
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

Eigen::Matrix<double, 7, 7> ArcCovariance(
    const Conic& circle,
    const FitSamples& samples,
    const std::vector<UncertainPoint>& points,
    bool is_whole) {
  const double n = static_cast<double>(samples.size());
  const double factor = Excess(circle, samples) * n / NumIndependent(samples);
  const std::vector<double> angles = UnwrappedAngles(circle, samples);
  const double middle = (angles.front() + angles.back()) / 2;
  const double half = std::max(std::abs(angles.back() - middle), 1e-9);
  const ArcFrame frame(circle, middle, ReachOf(angles, middle));
  std::vector<Observation> in_plane, off_plane;
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const FitSample& s = samples[i];
    const double t = angles[i];
    const double squared = (s.position - circle.At(t)).squaredNorm();
    const double weight = RobustWeight(squared, s.sigma, kNumRounds - 1);
    const double own = s.sigma * s.sigma - s.common * s.common;
    const Vector3d shared =
        s.common * SharedModes((t - middle) / half, t, is_whole);
    in_plane.push_back({frame.RowInPlane(t), weight, factor * own, shared});
    off_plane.push_back({frame.RowOffPlane(t), weight, factor * own, shared});
    sum += weight;
  }
  for (const UncertainPoint& p : points) {
    const double t = NearestParameter(circle, p.position);
    const Vector3d out = circle.frame * Vector3d(std::cos(t), std::sin(t), 0);
    const Vector3d normal = frame.normal();
    const double weight = kFixedWeight * sum;
    in_plane.push_back(
        {frame.RowInPlane(t), weight, out.dot(p.covariance * out)});
    off_plane.push_back(
        {frame.RowOffPlane(t), weight, normal.dot(p.covariance * normal)});
  }
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  covariance.topLeftCorner<3, 3>() = CovarianceOf(in_plane);
  covariance.bottomRightCorner<3, 3>() = CovarianceOf(off_plane);
  const Eigen::Matrix<double, 7, 6> world = frame.ToWorld();
  return world * covariance * world.transpose();
}

}  // namespace curvix
