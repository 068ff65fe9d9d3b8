// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Clamped cubic B-splines with even knots.
#include "fitting/primitive.h"

#include <Eigen/Dense>
#include <array>

namespace curvix {
namespace {

constexpr int kNumSlides = 3;

// The four basis functions that are not zero at t, and the first one's index.
struct Basis {
  std::size_t first = 0;
  std::array<double, 4> values;
};

// Cox and de Boor's recursion.
Basis BasisAt(const std::vector<double>& knots, double t) {
  const auto next = std::upper_bound(knots.begin() + 4, knots.end() - 4, t);
  const auto span = static_cast<std::size_t>(next - knots.begin()) - 1;
  Basis basis{span - 3, {1, 0, 0, 0}};
  for (std::size_t degree = 1; degree <= 3; ++degree) {
    double carried = 0;
    for (std::size_t j = 0; j < degree; ++j) {
      const double right = knots[span + 1 + j];
      const double left = knots[span + 1 + j - degree];
      const double share = basis.values[j] / (right - left);
      basis.values[j] = carried + (right - t) * share;
      carried = (t - left) * share;
    }
    basis.values[degree] = carried;
  }
  return basis;
}

std::vector<double> LengthShares(FitSpan samples) {
  std::vector<double> shares(samples.size(), 0.0);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    shares[i] =
        shares[i - 1] + (samples[i].position - samples[i - 1].position).norm();
  }
  const double length = shares.back();
  if (length > 0) {
    for (double& share : shares) share /= length;
  }
  return shares;
}

// Moves each parameter to the foot of its sample, by Newton's method.
void Slide(const Spline& spline,
           FitSpan samples,
           std::vector<double>& parameters) {
  constexpr double kDelta = 1e-5;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double& t = parameters[i];
    const double low = std::max(0.0, t - kDelta);
    const double high = std::min(1.0, t + kDelta);
    const Eigen::Vector3d speed =
        (spline.At(high) - spline.At(low)) / (high - low);
    if (!(speed.squaredNorm() > 0)) continue;
    const Eigen::Vector3d offset = samples[i].position - spline.At(t);
    t = std::clamp(t + offset.dot(speed) / speed.squaredNorm(), 0.0, 1.0);
  }
}

// The control points that minimise the weighted squares; those of fixed ends
// are given.
bool Solve(FitSpan samples,
           const std::vector<double>& parameters,
           const std::vector<double>& weights,
           bool ends_are_fixed,
           Spline& spline) {
  const auto n = static_cast<Eigen::Index>(spline.control_points.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(n, 3);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Basis basis = BasisAt(spline.knots, parameters[i]);
    const auto first = static_cast<Eigen::Index>(basis.first);
    const Eigen::Map<const Eigen::Vector4d> row(basis.values.data());
    normal.block<4, 4>(first, first) += weights[i] * row * row.transpose();
    right.middleRows<4>(first) +=
        weights[i] * row * samples[i].position.transpose();
  }
  const double mean = normal.diagonal().mean();
  const auto fixed = spline.control_points;
  if (ends_are_fixed) {
    for (const auto& [k, end] :
         {std::pair(Eigen::Index(0), fixed.front()), {n - 1, fixed.back()}}) {
      right -= normal.col(k) * end.transpose();
      normal.row(k).setZero();
      normal.col(k).setZero();
      normal(k, k) = mean;
      right.row(k) = mean * end.transpose();
    }
  }
  const double ridge = 1e-9 * mean;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!(normal(k, k) > ridge)) return false;
  }
  const Eigen::MatrixX3d solution = normal.ldlt().solve(right);
  if (!solution.allFinite()) return false;
  for (Eigen::Index k = 0; k < n; ++k) {
    spline.control_points[static_cast<std::size_t>(k)] = solution.row(k);
  }
  if (ends_are_fixed) {  // to the last bit
    spline.control_points.front() = fixed.front();
    spline.control_points.back() = fixed.back();
  }
  return true;
}

// The knots of a spline with `num_control_points`: 0 and 1 four times, even
// steps between.
std::vector<double> EvenKnots(std::size_t num_control_points) {
  std::vector<double> knots(4, 0.0);
  const std::size_t num_spans = num_control_points - 3;
  for (std::size_t k = 1; k < num_spans; ++k) {
    knots.push_back(static_cast<double>(k) / static_cast<double>(num_spans));
  }
  knots.insert(knots.end(), 4, 1.0);
  return knots;
}

}  // namespace

Eigen::Vector3d SplineAt(const std::vector<Eigen::Vector3d>& control_points,
                         const std::vector<double>& knots,
                         double t) {
  const Basis basis = BasisAt(knots, t);
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    point += basis.values[k] * control_points[basis.first + k];
  }
  return point;
}

Eigen::Vector3d Spline::At(double t) const {
  return SplineAt(control_points, knots, t);
}

std::optional<Spline> FitSpline(
    FitSpan samples,
    std::size_t num_control_points,
    const std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& ends) {
  if (samples.size() < num_control_points) return std::nullopt;
  Spline spline;
  spline.knots = EvenKnots(num_control_points);
  spline.control_points.assign(num_control_points, Eigen::Vector3d::Zero());
  if (ends) {
    spline.control_points.front() = ends->first;
    spline.control_points.back() = ends->second;
  }
  std::vector<double> parameters = LengthShares(samples);
  std::vector<double> weights = EqualWeights(samples);
  for (int slide = 0; slide <= kNumSlides; ++slide) {
    if (!Solve(samples, parameters, weights, ends.has_value(), spline)) {
      return std::nullopt;
    }
    Slide(spline, samples, parameters);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double squared =
          (samples[i].position - spline.At(parameters[i])).squaredNorm();
      weights[i] = RobustWeight(
          squared, samples[i].sigma, kNumRounds - 1 - kNumSlides + slide);
    }
  }
  return spline;
}

std::vector<double> SquaredDistances(const Spline& spline, FitSpan samples) {
  std::vector<double> parameters = LengthShares(samples);
  for (int slide = 0; slide < kNumSlides; ++slide) {
    Slide(spline, samples, parameters);
  }
  std::vector<double> squared;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    squared.push_back(
        (samples[i].position - spline.At(parameters[i])).squaredNorm());
  }
  return squared;
}

}  // namespace curvix
