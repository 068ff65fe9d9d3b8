// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The points in which primitives meet.
#include "fitting/end_covariance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <variant>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr int kNumSteps = 10;
constexpr double kMaxMoveSigmas = 10;
constexpr double kMaxMissSigmas = 3;
constexpr double kMaxSlide = 0.25;  // along a line or arc, of its length

using End = CurveNode::End;

const PrimitiveEnd& EndAt(const End& end,
                          const std::vector<CurvePrimitives>& curves) {
  const PrimitiveOfCurve& primitive = curves[end.curve_idx][end.fit_idx];
  return end.at_end ? primitive.at_end : primitive.at_start;
}

// Ends that share a sample's place, by the first of them.
std::vector<CurveNode> GroupEnds(const std::vector<CurvePrimitives>& curves) {
  std::map<std::array<double, 3>, std::size_t> node_at;
  std::vector<CurveNode> nodes;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (std::size_t f = 0; f < curves[c].size(); ++f) {
      if (curves[c][f].primitive.closed) continue;
      for (const bool at_end : {false, true}) {
        const End end{c, f, at_end};
        const Eigen::Vector3d& p = EndAt(end, curves).sample.position;
        const auto [place, is_new] =
            node_at.try_emplace({p.x(), p.y(), p.z()}, nodes.size());
        if (is_new) nodes.push_back({p, {}});
        nodes[place->second].ends.push_back(end);
      }
    }
  }
  return nodes;
}

// Where the lines and arcs of the ends come nearest to each other; along a
// direction that all of them share, as `place`.
Eigen::Vector3d Nearest(const Eigen::Vector3d& place,
                        const std::vector<End>& ends,
                        const std::vector<CurvePrimitives>& curves) {
  constexpr double kPull = 1e-3;  // of the old place
  Eigen::Vector3d point = place;
  for (int step = 0; step < kNumSteps; ++step) {
    Eigen::Matrix3d normal = kPull * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = kPull * (place - point);
    bool any = false;
    for (const End& end : ends) {
      const auto foot =
          FootOn(curves[end.curve_idx][end.fit_idx].primitive.shape, point);
      if (!foot) continue;
      any = true;
      const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() -
                                     foot->tangent * foot->tangent.transpose();
      normal += across;
      right += across * (foot->position - point);
    }
    if (!any) return place;
    point += normal.ldlt().solve(right);
  }
  return point;
}

// How far `point` is from the shape of an end, in standard deviations of its
// sample; 0 for splines.
double Miss(const Eigen::Vector3d& point,
            const End& end,
            const std::vector<CurvePrimitives>& curves) {
  const auto foot =
      FootOn(curves[end.curve_idx][end.fit_idx].primitive.shape, point);
  if (!foot) return 0;
  return (foot->position - point).norm() / EndAt(end, curves).sample.sigma;
}

// How far `point` is from the foot of an end's sample, along a line or arc, as
// a share of what is between its first and last sample; 0 for splines.
double SlideShare(const Eigen::Vector3d& point,
                  const End& end,
                  const std::vector<CurvePrimitives>& curves) {
  const PrimitiveOfCurve& own = curves[end.curve_idx][end.fit_idx];
  const Eigen::Vector3d& from = own.at_start.foot;
  const Eigen::Vector3d& to = own.at_end.foot;
  const Eigen::Vector3d& foot = EndAt(end, curves).foot;
  if (const auto* line = std::get_if<FittedLine>(&own.primitive.shape)) {
    return std::abs(line->direction().dot(point - foot)) / (to - from).norm();
  }
  const auto* conic = std::get_if<Conic>(&own.primitive.shape);
  if (conic == nullptr) return 0;
  const double start = NearestParameter(*conic, from);
  const double sweep = NearestParameter(*conic, to) - start;
  const double move =
      NearestParameter(*conic, point) - NearestParameter(*conic, foot);
  return std::abs(WrapDirected(move)) / (sweep > 0 ? sweep : sweep + 2 * kPi);
}

// Moves the node to where its lines and arcs meet. It loses those that miss
// the others, the farthest first.
void Meet(const std::vector<CurvePrimitives>& curves, CurveNode& node) {
  const Eigen::Vector3d place = node.position;
  while (node.ends.size() > 1) {
    node.position = Nearest(place, node.ends, curves);
    double sigma = 0;
    for (const End& end : node.ends) {
      sigma = std::max(sigma, EndAt(end, curves).sample.sigma);
    }
    const double move = (node.position - place).norm();
    const bool is_far = std::ranges::any_of(node.ends, [&](const End& end) {
      return !(SlideShare(node.position, end, curves) <= kMaxSlide);
    });
    if (is_far || move > kMaxMoveSigmas * sigma) node.position = place;
    std::vector<double> misses;
    for (const End& end : node.ends) {
      misses.push_back(Miss(node.position, end, curves));
    }
    const auto worst = std::ranges::max_element(misses);
    if (*worst <= kMaxMissSigmas) return;
    node.ends.erase(node.ends.begin() + (worst - misses.begin()));
  }
}

Eigen::Matrix3d CovarianceOf(const CurveNode& node,
                             const std::vector<CurvePrimitives>& curves) {
  std::vector<PrimitiveEnd> ends;
  for (const End& end : node.ends) {
    ends.push_back(EndAt(end, curves));
  }
  return MeetingCovariance(ends, node.position);
}

}  // namespace

std::vector<CurveNode> MeetInNodes(std::vector<CurvePrimitives>& curves) {
  std::vector<CurveNode> nodes = GroupEnds(curves);
  for (CurveNode& node : nodes) Meet(curves, node);
  std::erase_if(nodes, [](const CurveNode& n) { return n.ends.size() < 2; });
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    nodes[n].covariance = CovarianceOf(nodes[n], curves);
    for (const End& end : nodes[n].ends) {
      PrimitiveOfCurve& primitive = curves[end.curve_idx][end.fit_idx];
      (end.at_end ? primitive.at_end : primitive.at_start).node =
          static_cast<int>(n);
    }
  }
  return nodes;
}

}  // namespace curvix
