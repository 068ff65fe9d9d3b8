// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/main_axes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "base/angles.h"
#include "base/count_text.h"
#include "base/median.h"
#include "base/text_fields.h"
#include "geometry/directions.h"
#include "measuring/known_directions.h"

namespace curvix {
namespace {

constexpr std::size_t kMaxCandidates = 150;
constexpr double kToleranceDeg = 1.5;
constexpr double kPerpendicularDeg = 2;
constexpr int kNumRounds = 12;
// Cameras whose mean direction is longer than this look at a front.
constexpr double kLookingOneWay = 0.3;

using Directions = std::vector<KnownDirection>;

// Columns: the axes in the model.
using Frame = Eigen::Matrix3d;

// The square of the sine between a direction and an axis.
double SquaredSine(const KnownDirection& d, const Eigen::Vector3d& axis) {
  return d.along.cross(axis).squaredNorm();
}

// Within which a direction counts as one of an axis.
double SquaredTolerance(const KnownDirection& d) {
  const double tolerance = std::sin(DegToRad(kToleranceDeg));
  return tolerance * tolerance + d.variance;
}

// The axis that a direction shares, or -1.
int AxisOf(const KnownDirection& d, const Frame& frame) {
  int nearest = 0;
  (frame.transpose() * d.along).cwiseAbs().maxCoeff(&nearest);
  return SquaredSine(d, frame.col(nearest)) < SquaredTolerance(d) ? nearest
                                                                  : -1;
}

// Of each direction: the length of it and of all after it, rounded up.
std::vector<double> LengthsLeft(const Directions& directions) {
  constexpr double kRounding = 1 + 1e-9;
  std::vector<double> left(directions.size());
  double sum = 0;
  for (std::size_t i = left.size(); i-- > 0;) {
    sum += kRounding * directions[i].length;
    left[i] = sum;
  }
  return left;
}

// The length of the directions that share an axis, those further off less.
// Stops early, with any smaller result, if it is at most `most`. `left`:
// LengthsLeft().
double LengthAlong(const Directions& directions,
                   const std::vector<double>& left,
                   const Frame& frame,
                   double most) {
  double sum = 0;
  for (std::size_t i = 0; i < left.size() && sum + left[i] > most; ++i) {
    const KnownDirection& d = directions[i];
    const int axis = AxisOf(d, frame);
    if (axis < 0) continue;
    sum +=
        d.length * (1 - SquaredSine(d, frame.col(axis)) / SquaredTolerance(d));
  }
  return sum;
}

std::optional<Frame> BestFrame(const Directions& directions) {
  const std::size_t n = std::min(directions.size(), kMaxCandidates);
  const double limit = std::sin(DegToRad(kPerpendicularDeg));
  const std::vector<double> left = LengthsLeft(directions);
  std::optional<Frame> best;
  double most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const Eigen::Vector3d& first = directions[i].along;
      const Eigen::Vector3d& second = directions[j].along;
      if (std::abs(first.dot(second)) > limit) continue;
      Frame frame;
      frame.col(0) = first;
      frame.col(1) = (second - first.dot(second) * first).normalized();
      frame.col(2) = frame.col(0).cross(frame.col(1));
      const double length = LengthAlong(directions, left, frame, most);
      if (length > most) best = frame;
      most = std::max(most, length);
    }
  }
  return best;
}

// A direction along an axis, and its weight.
struct Member {
  const KnownDirection* direction;
  int axis;
  double weight;
};

// Errors are those of the directions and the scatter of real ones, which is the
// median of what is left.
std::vector<Member> MembersOf(const Directions& directions,
                              const Frame& frame) {
  std::vector<Member> members;
  std::vector<double> left;
  for (const KnownDirection& d : directions) {
    const int axis = AxisOf(d, frame);
    if (axis < 0) continue;
    members.push_back({&d, axis, 0});
    left.push_back(SquaredSine(d, frame.col(axis)) / 2);
  }
  const double scatter = MedianOr(0, left);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const double variance =
        std::max(members[i].direction->variance + scatter, 1e-16);
    members[i].weight = 1 / (variance * (1 + left[i] / variance));
  }
  return members;
}

// The turn of the frame that brings it nearest to the members, about its own
// axes; its covariance.
struct Turn {
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

Turn BestTurn(const std::vector<Member>& members, const Frame& frame) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0;
  for (const Member& m : members) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(m.axis);
    Eigen::Vector3d seen = frame.transpose() * m.direction->along;
    if (seen(m.axis) < 0) seen = -seen;
    // A turn w moves the axis by w x axis.
    const Eigen::Vector3d angles = axis.cross(seen);
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - axis * axis.transpose();
    normal += m.weight * across;
    right += m.weight * angles;
    squares += m.weight * angles.squaredNorm();
  }
  Turn turn;
  const double free = 2.0 * static_cast<double>(members.size()) - 3;
  turn.angles = normal.ldlt().solve(right);
  turn.covariance =
      std::max(1.0, squares / std::max(free, 1.0)) * normal.inverse();
  return turn;
}

Frame Refined(const Directions& directions, Frame frame) {
  for (int round = 0; round < kNumRounds; ++round) {
    const Turn turn = BestTurn(MembersOf(directions, frame), frame);
    const double angle = turn.angles.norm();
    if (!(angle > 0) || !std::isfinite(angle)) break;
    frame = frame * Eigen::AngleAxisd(angle, turn.angles / angle);
  }
  return frame;
}

// The same axes in another order and with other signs.
Frame Ordered(const Frame& frame,
              const Eigen::Vector3d& up,
              const Eigen::Vector3d& views_direction,
              const Directions& directions) {
  Eigen::Index z = 0;
  (frame.transpose() * up).cwiseAbs().maxCoeff(&z);
  Frame ordered;
  ordered.col(2) = frame.col(z) * (frame.col(z).dot(up) < 0 ? -1 : 1);
  const Eigen::Vector3d a = frame.col((z + 1) % 3);
  const Eigen::Vector3d b = frame.col((z + 2) % 3);
  const Eigen::Vector3d flat =
      views_direction - views_direction.dot(ordered.col(2)) * ordered.col(2);
  if (flat.norm() > kLookingOneWay) {
    const bool is_a = std::abs(flat.dot(a)) > std::abs(flat.dot(b));
    const Eigen::Vector3d forward = is_a ? a : b;
    ordered.col(1) = forward * (forward.dot(flat) < 0 ? -1 : 1);
    ordered.col(0) = ordered.col(1).cross(ordered.col(2));
    return ordered;
  }
  double along_a = 0, along_b = 0;
  for (const KnownDirection& d : directions) {
    if (SquaredSine(d, a) < SquaredTolerance(d)) along_a += d.length;
    if (SquaredSine(d, b) < SquaredTolerance(d)) along_b += d.length;
  }
  ordered.col(0) = Upright(along_a >= along_b ? a : b);
  ordered.col(1) = ordered.col(2).cross(ordered.col(0));
  return ordered;
}

// The mean direction of the members of an axis, and its variance.
std::optional<std::pair<Eigen::Vector3d, double>> MeanOf(
    const std::vector<Member>& members, const Frame& frame, int axis) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0, squares = 0;
  int count = 0;
  for (const Member& m : members) {
    if (m.axis != axis) continue;
    const Eigen::Vector3d& d = m.direction->along;
    sum += m.weight * (d.dot(frame.col(axis)) < 0 ? -d : d);
    weights += m.weight;
    ++count;
  }
  if (count == 0) return std::nullopt;
  const Eigen::Vector3d mean = sum.normalized();
  for (const Member& m : members) {
    if (m.axis == axis) squares += m.weight * SquaredSine(*m.direction, mean);
  }
  const double scatter = squares / std::max(1, 2 * count - 2);
  return std::pair(mean, std::max(1.0, scatter) / weights);
}

void JudgeAngles(const std::vector<Member>& members,
                 const Frame& frame,
                 MainAxes& result) {
  for (int i = 0; i < 3; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const auto first = MeanOf(members, frame, (i + 1) % 3);
    const auto second = MeanOf(members, frame, (i + 2) % 3);
    const double none = std::numeric_limits<double>::quiet_NaN();
    result.angle_deg[index] = result.angle_sigma_deg[index] = none;
    if (!first || !second) continue;
    result.angle_deg[index] =
        RadToDeg(std::acos(first->first.dot(second->first)));
    result.angle_sigma_deg[index] =
        RadToDeg(std::sqrt(first->second + second->second));
  }
}

Status NothingPerpendicular(std::size_t num_known, std::size_t num_unknown) {
  std::string message =
      "No two of the lines, axes of arcs and rows of circles (" +
      GroupDigits(static_cast<std::int64_t>(num_known)) +
      " in all) are perpendicular, so that axes cannot be found";
  if (num_unknown > 0) {
    message += "; " + GroupDigits(static_cast<std::int64_t>(num_unknown)) +
               " more are not used, since the standard deviation of their "
               "direction is above " +
               FixedText(kKnownDeg, 1) + " degrees";
  }
  return Status::Unsupported(message);
}

// `axis`: of each camera.
Eigen::Vector3d MeanOfAxis(const std::vector<View>& views,
                           const Eigen::Vector3d& axis) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const View& view : views) {
    sum += view.cam_from_world.rotation.conjugate() * axis;
  }
  return sum / std::max<double>(1, static_cast<double>(views.size()));
}

}  // namespace

Result<MainAxes> FindMainAxes(const FittedCurves& fitted,
                              const Eigen::Vector3d& up,
                              const Eigen::Vector3d& views_direction) {
  const auto [directions, num_unknown] = DirectionsOf(fitted);
  const std::optional<Frame> best = BestFrame(directions);
  if (!best) return NothingPerpendicular(directions.size(), num_unknown);
  const Frame frame =
      Ordered(Refined(directions, *best), up, views_direction, directions);
  const std::vector<Member> members = MembersOf(directions, frame);
  MainAxes result;
  // The turn of the axes in the model is minus that of the model in the world.
  result.axes.world_from_model =
      Eigen::Quaterniond(Eigen::Matrix3d(frame.transpose())).normalized();
  result.axes.covariance = BestTurn(members, frame).covariance;
  for (const Member& m : members) {
    ++result.num_directions[static_cast<std::size_t>(m.axis)];
  }
  JudgeAngles(members, frame, result);
  return result;
}

Eigen::Vector3d MeanUp(const std::vector<View>& views) {
  return MeanOfAxis(views, -Eigen::Vector3d::UnitY());
}

Eigen::Vector3d MeanViewDirection(const std::vector<View>& views) {
  return MeanOfAxis(views, Eigen::Vector3d::UnitZ());
}

}  // namespace curvix
