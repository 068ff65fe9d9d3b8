// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/meet_in_nodes.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace curvix {
namespace {

constexpr int kNumSteps = 10;
constexpr double kMaxMoveSigmas = 10;

using End = CurveNode::End;

// The sample at an end.
const FitSample& SampleAt(const End& end,
                          const std::vector<CurvePrimitives>& curves) {
  const PrimitiveOfCurve& primitive = curves[end.curve_idx][end.fit_idx];
  return end.at_end ? primitive.end : primitive.start;
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
        const Eigen::Vector3d& p = SampleAt(end, curves).position;
        const auto [place, is_new] =
            node_at.try_emplace({p.x(), p.y(), p.z()}, nodes.size());
        if (is_new) nodes.push_back({p, {}});
        nodes[place->second].ends.push_back(end);
      }
    }
  }
  std::erase_if(nodes, [](const CurveNode& n) { return n.ends.size() < 2; });
  return nodes;
}

// Where the lines and arcs of the node come nearest to each other; along a
// direction that all of them share, the node stays.
Eigen::Vector3d Nearest(const CurveNode& node,
                        const std::vector<CurvePrimitives>& curves) {
  constexpr double kPull = 1e-3;  // of the old place
  Eigen::Vector3d point = node.position;
  for (int step = 0; step < kNumSteps; ++step) {
    Eigen::Matrix3d normal = kPull * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = kPull * (node.position - point);
    bool any = false;
    for (const End& end : node.ends) {
      const auto foot =
          FootOn(curves[end.curve_idx][end.fit_idx].primitive.shape, point);
      if (!foot) continue;
      any = true;
      const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() -
                                     foot->tangent * foot->tangent.transpose();
      normal += across;
      right += across * (foot->position - point);
    }
    if (!any) return node.position;
    point += normal.ldlt().solve(right);
  }
  return point;
}

Eigen::Matrix3d CovarianceOf(const CurveNode& node,
                             const std::vector<CurvePrimitives>& curves) {
  std::vector<PrimitiveEnd> ends;
  for (const End& end : node.ends) {
    const PrimitiveOfCurve& primitive = curves[end.curve_idx][end.fit_idx];
    ends.push_back(end.at_end ? primitive.at_end : primitive.at_start);
  }
  return MeetingCovariance(ends, node.position);
}

}  // namespace

std::vector<CurveNode> MeetInNodes(const std::vector<CurvePrimitives>& curves) {
  std::vector<CurveNode> nodes = GroupEnds(curves);
  for (CurveNode& node : nodes) {
    const Eigen::Vector3d point = Nearest(node, curves);
    double sigma = 0;
    for (const End& end : node.ends) {
      sigma = std::max(sigma, SampleAt(end, curves).sigma);
    }
    const double move = (point - node.position).norm();
    if (move <= kMaxMoveSigmas * sigma) node.position = point;
    node.covariance = CovarianceOf(node, curves);
  }
  return nodes;
}

}  // namespace curvix
