// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/visible_side.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "base/angles.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

constexpr double kPriorAllAround = 0.5;
// Angles that differ by less are the same, radians.
constexpr double kSameAngle = 1e-9;

// Angles about the tangent of an edge.
class Azimuths {
 public:
  explicit Azimuths(const SpaceEdge& edge) : edge_(edge) {
    int axis = 0;
    edge.tangent.cwiseAbs().minCoeff(&axis);
    normal_ = edge.tangent.cross(Vector3d::Unit(axis)).normalized();
    binormal_ = edge.tangent.cross(normal_);
  }

  double Of(const Vector3d& center) const {
    const Vector3d ray = center - edge_.position;
    return std::atan2(ray.dot(binormal_), ray.dot(normal_));
  }
  Vector3d Direction(double azimuth) const {
    return std::cos(azimuth) * normal_ + std::sin(azimuth) * binormal_;
  }

 private:
  const SpaceEdge& edge_;
  Vector3d normal_, binormal_;
};

// From one azimuth forth to another, in [0, 2 pi).
double Turn(double from, double to) {
  const double turn = std::fmod(to - from, 2 * kPi);
  return turn < 0 ? turn + 2 * kPi : turn;
}

// A half turn that holds the same views if it begins up to `slack` before
// `begin`, radians.
struct HalfTurn {
  double begin = 0;
  double slack = 0;
};

// The half turns that begin at a view in favour; others hold no more of these.
// `azimuths` of all views with a vote.
std::vector<HalfTurn> HalfTurns(const std::vector<double>& azimuths,
                                const std::vector<double>& in_favour) {
  std::vector<HalfTurn> half_turns;
  for (const double begin : in_favour) {
    double slack = kPi;
    for (const double azimuth : azimuths) {
      // A view enters at the end, or leaves at the beginning.
      for (const double change : {azimuth - kPi, azimuth}) {
        const double turn = Turn(change, begin);
        if (turn > kSameAngle) slack = std::min(slack, turn);
      }
    }
    half_turns.push_back({begin, slack});
  }
  return half_turns;
}

double Rounded(double evidence) { return std::round(1e6 * evidence) / 1e6; }

}  // namespace

bool IsInFront(const Vector3d& center,
               const SpaceEdge& edge,
               const std::optional<Vector3d>& facing) {
  if (!facing) return true;
  const Vector3d across = *facing - facing->dot(edge.tangent) * edge.tangent;
  return across.dot(center - edge.position) > 0;
}

VisibleSide FindVisibleSide(const SpaceEdge& edge,
                            const Votes& votes,
                            const NeighborsByView& neighbors,
                            const std::vector<ViewIndex>& views) {
  const Azimuths azimuths(edge);
  std::vector<double> all;
  std::vector<double> in_favour;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (!votes[i]) continue;
    all.push_back(azimuths.Of(views[i].view->center));
    if (*votes[i] > 0) in_favour.push_back(all.back());
  }
  VisibleSide best{
      std::max(0.0, Evidence(votes, neighbors) + std::log(kPriorAllAround)),
      std::nullopt};
  double best_slack = 2 * kPi;
  for (const HalfTurn& half_turn : HalfTurns(all, in_favour)) {
    const double middle = half_turn.begin - half_turn.slack / 2 + kPi / 2;
    const Vector3d facing = azimuths.Direction(middle);
    Votes in_front = votes;
    for (std::size_t i = 0; i < votes.size(); ++i) {
      if (votes[i] && !IsInFront(views[i].view->center, edge, facing)) {
        in_front[i].reset();
      }
    }
    const double prior = (1 - kPriorAllAround) * half_turn.slack / (2 * kPi);
    const double evidence = Evidence(in_front, neighbors) + std::log(prior);
    if (std::tuple(Rounded(evidence), half_turn.slack) >
        std::tuple(Rounded(best.evidence), best_slack)) {
      best = {evidence, facing};
      best_slack = half_turn.slack;
    }
  }
  return best;
}

}  // namespace curvix
