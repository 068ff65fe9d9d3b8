// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Circles and ellipses in space.
#include "fitting/primitive.h"

#include <Eigen/Dense>
#include <cmath>

namespace curvix {

Eigen::Vector3d Conic::At(double t) const {
  return center + frame * Eigen::Vector3d(a * std::cos(t), b * std::sin(t), 0);
}

Eigen::Vector3d Conic::Tangent(double t) const {
  return frame *
         Eigen::Vector3d(-a * std::sin(t), b * std::cos(t), 0).normalized();
}

double NearestParameter(const Conic& conic, const Eigen::Vector3d& point) {
  const Eigen::Vector3d local = conic.Local(point);
  if (conic.a == conic.b) return std::atan2(local.y(), local.x());
  constexpr int kNumSteps = 6;
  const Eigen::Array2d axes(conic.a, conic.b);
  const Eigen::Array2d p = local.head<2>().array().abs();
  // (cos t, sin t) in the first quadrant. The point is seen from the centre of
  // curvature e at t; the ellipse is met where the circle about e would be.
  Eigen::Array2d unit = Eigen::Array2d::Constant(std::sqrt(0.5));
  for (int step = 0; step < kNumSteps; ++step) {
    const double difference = conic.a * conic.a - conic.b * conic.b;
    const Eigen::Array2d cube = unit * unit * unit;
    const Eigen::Array2d e(difference * cube.x() / conic.a,
                           -difference * cube.y() / conic.b);
    const double radius = (axes * unit - e).matrix().norm();
    const double distance = (p - e).matrix().norm();
    if (!(distance > 0)) break;
    unit = ((p - e) * (radius / distance) + e) / axes;
    unit = unit.max(0.0).min(1.0);
    unit /= std::max(unit.matrix().norm(), 1e-300);
  }
  return std::atan2(std::copysign(unit.y(), local.y()),
                    std::copysign(unit.x(), local.x()));
}

double SquaredDistance(const Conic& conic, const Eigen::Vector3d& point) {
  if (conic.a == conic.b) {
    const Eigen::Vector3d local = conic.Local(point);
    const double off = local.head<2>().norm() - conic.a;
    return off * off + local.z() * local.z();
  }
  return (point - conic.At(NearestParameter(conic, point))).squaredNorm();
}

namespace {

constexpr double kMaxAxisRatio = 20;
constexpr double kMaxStep = 0.7;  // in units of the axes, and radians
constexpr std::size_t kMinCircleSamples = 4;
constexpr std::size_t kMinEllipseSamples = 6;

// The plane of the samples: its frame (z is the normal) and their mean.
Conic PlaneOf(FitSpan samples, const std::vector<double>& weights) {
  const auto [mean, scatter] = WeightedScatter(samples, weights);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  Conic plane;
  plane.center = mean;
  plane.frame.col(0) = eigen.eigenvectors().col(2);
  plane.frame.col(1) = eigen.eigenvectors().col(1);
  plane.frame.col(2) = plane.frame.col(0).cross(plane.frame.col(1));
  return plane;
}

// The circle x^2 + y^2 = 2 u x + 2 v y + w with the least squares of the
// difference of both sides.
std::optional<Conic> WeightedCircle(FitSpan samples,
                                    const std::vector<double>& weights) {
  Conic circle = PlaneOf(samples, weights);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double extent = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector2d p = circle.Local(samples[i].position).head<2>();
    const Eigen::Vector3d row(2 * p.x(), 2 * p.y(), 1);
    normal += weights[i] * row * row.transpose();
    right += weights[i] * p.squaredNorm() * row;
    extent = std::max(extent, p.squaredNorm());
  }
  const Eigen::Vector3d uvw = normal.ldlt().solve(right);
  const double squared_radius = uvw.z() + uvw.head<2>().squaredNorm();
  if (!uvw.allFinite() || !(squared_radius > 0)) return std::nullopt;
  if (squared_radius > 1e8 * extent) return std::nullopt;
  circle.center += circle.frame.leftCols<2>() * uvw.head<2>();
  circle.a = circle.b = std::sqrt(squared_radius);
  return circle;
}

// At most eight unknowns; on the stack.
using Step = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;
using NormalMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;

// The conic after a step: 3 for the centre, 3 for the turn (in the frame), and
// the logarithm of the axes. A circle has one axis and no turn about z.
Conic Moved(const Conic& conic, const Step& step, bool is_circle) {
  Conic moved = conic;
  const double size = conic.a;
  moved.center += size * (conic.frame * step.head<3>());
  const Eigen::Vector3d turn(step(3), step(4), is_circle ? 0 : step(6));
  if (turn.norm() > 0) {
    moved.frame =
        conic.frame *
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  moved.a *= std::exp(step(5));
  moved.b = is_circle ? moved.a : conic.b * std::exp(step(7));
  return moved;
}

// In-plane and off-plane distance of a point, each with its sign.
Eigen::Vector2d SignedDistances(const Conic& conic,
                                const Eigen::Vector3d& point) {
  const Eigen::Vector3d local = conic.Local(point);
  if (conic.a == conic.b) {
    return {local.head<2>().norm() - conic.a, local.z()};
  }
  const double t = NearestParameter(conic, point);
  const Eigen::Vector2d normal =
      Eigen::Vector2d(conic.b * std::cos(t), conic.a * std::sin(t))
          .normalized();
  const Eigen::Vector2d foot(conic.a * std::cos(t), conic.b * std::sin(t));
  return {normal.dot(local.head<2>() - foot), local.z()};
}

struct Target {
  Eigen::Vector3d position;
  double weight = 0;
};

// The Gauss-Newton step on the distances of the targets, for Moved.
Step StepOf(const std::vector<Target>& targets,
            bool is_circle,
            const Conic& conic) {
  const Eigen::Index n = is_circle ? 6 : 8;
  constexpr double kDelta = 1e-6;
  NormalMatrix normal = NormalMatrix::Zero(n, n);
  Step right = Step::Zero(n);
  std::vector<Conic> nudged;
  for (Eigen::Index k = 0; k < n; ++k) {
    nudged.push_back(Moved(conic, kDelta * Step::Unit(n, k), is_circle));
  }
  for (const Target& target : targets) {
    const Eigen::Vector2d residual = SignedDistances(conic, target.position);
    Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 8> jacobian(2, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      jacobian.col(k) = (SignedDistances(nudged[static_cast<std::size_t>(k)],
                                         target.position) -
                         residual) /
                        kDelta;
    }
    normal.noalias() +=
        target.weight * jacobian.transpose().lazyProduct(jacobian);
    right -= target.weight * jacobian.transpose() * residual;
  }
  normal.diagonal() *= 1 + 1e-9;
  return normal.ldlt().solve(right);
}

double CostOf(const std::vector<Target>& targets, const Conic& conic) {
  double cost = 0;
  for (const Target& t : targets) {
    cost += t.weight * SquaredDistance(conic, t.position);
  }
  return cost;
}

// Gauss-Newton from `conic`, with steps halved until they go down.
Conic Descend(const std::vector<Target>& targets, bool is_circle, Conic conic) {
  constexpr int kNumSteps = 20;
  constexpr double kLeastShare = 1.0 / 64;
  double least = CostOf(targets, conic);
  for (int i = 0; i < kNumSteps; ++i) {
    const Step step = StepOf(targets, is_circle, conic);
    if (!step.allFinite()) break;
    double share = std::min(1.0, kMaxStep / step.cwiseAbs().maxCoeff());
    double cost = least;
    for (; share > kLeastShare; share /= 2) {
      const Conic moved = Moved(conic, share * step, is_circle);
      cost = CostOf(targets, moved);
      if (!(cost < least)) continue;
      conic = moved;
      break;
    }
    if (!(cost < (1 - 1e-12) * least)) break;
    least = cost;
  }
  return conic;
}

// nullopt: the points are on a line.
std::optional<Conic> CircleThrough(const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c) {
  constexpr double kFlat = 1e-6;  // sine of the least angle
  const Eigen::Vector3d u = a - b, v = c - b;
  const Eigen::Vector3d normal = u.cross(v);
  if (!(normal.norm() > kFlat * u.norm() * v.norm())) return std::nullopt;
  const Eigen::Vector3d to_center =
      (u.squaredNorm() * v - v.squaredNorm() * u).cross(normal) /
      (2 * normal.squaredNorm());
  Conic circle;
  circle.center = b + to_center;
  circle.a = circle.b = to_center.norm();
  circle.frame.col(0) = -to_center.normalized();
  circle.frame.col(2) = normal.normalized();
  circle.frame.col(1) = circle.frame.col(2).cross(circle.frame.col(0));
  return circle;
}

// Axes in order, as Conic promises.
Conic Ordered(Conic conic) {
  if (conic.a < conic.b) {
    std::swap(conic.a, conic.b);
    const Eigen::Vector3d x = conic.frame.col(0);
    conic.frame.col(0) = conic.frame.col(1);
    conic.frame.col(1) = -x;
  }
  return conic;
}

std::optional<Conic> Refine(Conic conic, FitSpan samples, bool is_circle) {
  std::vector<Target> targets(samples.size());
  for (int round = 0; round < kNumRounds; ++round) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const FitSample& s = samples[i];
      targets[i] = {
          s.position,
          RobustWeight(SquaredDistance(conic, s.position), s.sigma, round)};
    }
    const Step step = StepOf(targets, is_circle, conic);
    if (!(step.cwiseAbs().maxCoeff() <= kMaxStep)) return std::nullopt;
    conic = Moved(conic, step, is_circle);
    if (!(conic.a < kMaxAxisRatio * conic.b &&
          conic.b < kMaxAxisRatio * conic.a)) {
      return std::nullopt;
    }
    conic = Ordered(conic);
  }
  return conic;
}

// The direct least-squares ellipse of Fitzgibbon, Pilu and Fisher, its linear
// terms eliminated as by Halir and Flusser, in the plane of the samples.
std::optional<Conic> DirectEllipse(FitSpan samples) {
  Conic plane = PlaneOf(samples, EqualWeights(samples));
  double scale = 0;
  for (const FitSample& s : samples) {
    scale = std::max(scale, (s.position - plane.center).norm());
  }
  Eigen::Matrix3d s1 = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d s2 = s1, s3 = s1;
  for (const FitSample& s : samples) {
    const Eigen::Vector2d p = plane.Local(s.position).head<2>() / scale;
    const Eigen::Vector3d quadratic(
        p.x() * p.x(), p.x() * p.y(), p.y() * p.y());
    const Eigen::Vector3d linear(p.x(), p.y(), 1);
    s1 += quadratic * quadratic.transpose();
    s2 += quadratic * linear.transpose();
    s3 += linear * linear.transpose();
  }
  const Eigen::Matrix3d t = -s3.ldlt().solve(s2.transpose());
  Eigen::Matrix3d m = s1 + s2 * t;
  m.diagonal().array() += 1e-14 * m.trace();  // exact samples: singular
  if (!m.allFinite()) return std::nullopt;
  // For ellipses, q^T ellipticity q = 4 q0 q2 - q1^2 is positive: only one
  // eigenvalue, the largest, is.
  Eigen::Matrix3d ellipticity;
  ellipticity << 0, 0, 2, 0, -1, 0, 2, 0, 0;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
      ellipticity, m);
  if (eigen.info() != Eigen::Success) return std::nullopt;
  const Eigen::Vector3d q = eigen.eigenvectors().col(2).normalized();
  const Eigen::Vector3d l = t * q;
  // q0 x^2 + q1 x y + q2 y^2 + l0 x + l1 y + l2 = 0
  Eigen::Matrix2d form;
  form << q(0), q(1) / 2, q(1) / 2, q(2);
  const Eigen::Vector2d center = -0.5 * form.inverse() * l.head<2>();
  const double level = center.dot(form * center) - l(2);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(form / level);
  if (!(axes.eigenvalues()(0) > 0)) return std::nullopt;
  plane.center += scale * plane.frame.leftCols<2>() * center;
  plane.a = scale / std::sqrt(axes.eigenvalues()(0));
  plane.b = scale / std::sqrt(axes.eigenvalues()(1));
  const Eigen::Matrix<double, 3, 2> directions =
      plane.frame.leftCols<2>() * axes.eigenvectors();
  plane.frame.leftCols<2>() = directions;
  plane.frame.col(2) = plane.frame.col(0).cross(plane.frame.col(1));
  return plane;
}

}  // namespace

std::optional<Conic> RoughCircle(FitSpan samples) {
  if (samples.size() < 3) return std::nullopt;
  std::vector<double> weights = EqualWeights(samples);
  std::optional<Conic> circle = WeightedCircle(samples, weights);
  for (int round = 0; circle && round < kNumRounds; round += 2) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      weights[i] = RobustWeight(SquaredDistance(*circle, samples[i].position),
                                samples[i].sigma,
                                round);
    }
    circle = WeightedCircle(samples, weights);
  }
  return circle;
}

std::optional<Conic> FitCircle(FitSpan samples) {
  if (samples.size() < kMinCircleSamples) return std::nullopt;
  const std::optional<Conic> rough = RoughCircle(samples);
  if (!rough) return std::nullopt;
  return Refine(*rough, samples, true);
}

std::optional<Conic> FitEllipse(FitSpan samples) {
  if (samples.size() < kMinEllipseSamples) return std::nullopt;
  const std::optional<Conic> rough = DirectEllipse(samples);
  if (!rough) return std::nullopt;
  return Refine(*rough, samples, false);
}

std::optional<Conic> FitThrough(const Conic& conic,
                                FitSpan samples,
                                const std::optional<Eigen::Vector3d>& start,
                                const std::optional<Eigen::Vector3d>& end) {
  constexpr double kConstraint = 1e4;  // times the weight of all samples
  constexpr double kMaxMiss = 0.05;    // standard deviations
  const bool is_circle = conic.a == conic.b;
  std::vector<Target> targets;
  double sum = 0;
  for (const FitSample& s : samples) {
    const double squared = SquaredDistance(conic, s.position);
    targets.push_back(
        {s.position, RobustWeight(squared, s.sigma, kNumRounds - 1)});
    sum += targets.back().weight;
  }
  std::vector<Target> fixed;
  if (start) fixed.push_back({*start, kConstraint * sum});
  if (end) fixed.push_back({*end, kConstraint * sum});
  targets.insert(targets.end(), fixed.begin(), fixed.end());
  Conic best = Descend(targets, is_circle, conic);
  if (!is_circle) return Ordered(best);
  const auto foot = [&](const FitSample& s) {
    return conic.At(NearestParameter(conic, s.position));
  };
  // From here on the ends are in place, however far the nodes are.
  if (const auto through = CircleThrough(start.value_or(foot(samples.front())),
                                         foot(samples[samples.size() / 2]),
                                         end.value_or(foot(samples.back())))) {
    const Conic other = Descend(targets, is_circle, *through);
    if (CostOf(targets, other) < CostOf(targets, best)) best = other;
  }
  const double miss = kMaxMiss * samples.front().sigma;
  if (CostOf(fixed, best) > kConstraint * sum * miss * miss) {
    return std::nullopt;
  }
  return best;
}

}  // namespace curvix
