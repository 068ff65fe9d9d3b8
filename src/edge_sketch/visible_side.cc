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

// From one azimuth forth to another, in [0, 2 pi).
double Turn(double from, double to) {
  const double turn = std::fmod(to - from, 2 * kPi);
  return turn < 0 ? turn + 2 * kPi : turn;
}

// A half turn that begins at `begin` holds the same views if it begins up to so
// much earlier, radians. `azimuths` of all views with a vote.
double SlackBefore(double begin, const std::vector<double>& azimuths) {
  double slack = kPi;
  for (const double azimuth : azimuths) {
    // A view enters at the end, or leaves at the beginning.
    for (const double change : {azimuth - kPi, azimuth}) {
      const double turn = Turn(change, begin);
      if (turn > kSameAngle) slack = std::min(slack, turn);
    }
  }
  return slack;
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
  int axis = 0;
  edge.tangent.cwiseAbs().minCoeff(&axis);
  const Vector3d normal = edge.tangent.cross(Vector3d::Unit(axis)).normalized();
  const Vector3d binormal = edge.tangent.cross(normal);
  std::vector<double> azimuths;  // about the tangent, of views with a vote
  std::vector<double> in_favour;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (!votes[i]) continue;
    const Vector3d ray = views[i].view->center - edge.position;
    azimuths.push_back(std::atan2(ray.dot(binormal), ray.dot(normal)));
    if (LogLikelihoodRatio(*votes[i]) > 0) in_favour.push_back(azimuths.back());
  }
  VisibleSide best{
      std::max(0.0, Evidence(votes, neighbors) + std::log(kPriorAllAround)),
      std::nullopt};
  double best_slack = 2 * kPi;
  // Half turns that begin at another view hold no more of those in favour by
  // their places.
  for (const double begin : in_favour) {
    const double slack = SlackBefore(begin, azimuths);
    const double middle = begin - slack / 2 + kPi / 2;
    const Vector3d facing =
        std::cos(middle) * normal + std::sin(middle) * binormal;
    Votes in_front = votes;
    for (std::size_t i = 0; i < votes.size(); ++i) {
      if (votes[i] && !IsInFront(views[i].view->center, edge, facing)) {
        in_front[i].reset();
      }
    }
    const double prior = (1 - kPriorAllAround) * slack / (2 * kPi);
    const double evidence = Evidence(in_front, neighbors) + std::log(prior);
    if (std::tuple(Rounded(evidence), slack) >
        std::tuple(Rounded(best.evidence), best_slack)) {
      best = {evidence, facing};
      best_slack = slack;
    }
  }
  return best;
}

}  // namespace curvix
