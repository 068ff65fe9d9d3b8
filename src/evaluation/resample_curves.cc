// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/resample_curves.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/angles.h"
#include "model/curve_chains.h"

namespace curvix {
namespace {

struct TrueEnd {
  int curve_id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();  // unit, or zero
};

TrueEnd MakeEnd(int curve_id,
                const Eigen::Vector3d& end,
                const Eigen::Vector3d& inside) {
  const Eigen::Vector3d outward = end - inside;
  return {curve_id, end, outward / std::max(outward.norm(), 1e-15)};
}

// Both ends of each curve of at least three samples, by curve id.
std::vector<TrueEnd> FindEnds(const std::vector<TrueSample>& truth) {
  std::map<int, std::vector<Eigen::Vector3d>> curves;
  for (const TrueSample& sample : truth) {
    curves[sample.curve_id].push_back(sample.position);
  }
  std::vector<TrueEnd> ends;
  for (const auto& [id, points] : curves) {
    const std::size_t n = points.size();
    if (n < 3) continue;
    ends.push_back(MakeEnd(id, points[0], points[2]));
    ends.push_back(MakeEnd(id, points[n - 1], points[n - 3]));
  }
  return ends;
}

// Pairs of ends that continue each other; straight ones cost least.
std::vector<EndPair> FindPairs(const std::vector<TrueEnd>& ends,
                               double max_gap) {
  const double min_cosine = std::cos(DegToRad(15));
  std::vector<EndPair> pairs;
  for (EndIdx i = 0; i < ends.size(); ++i) {
    for (EndIdx j = i + 1; j < ends.size(); ++j) {
      if ((ends[i].position - ends[j].position).norm() >= max_gap) continue;
      const double cosine = ends[i].outward.dot(ends[j].outward);
      if (-cosine > min_cosine) pairs.push_back({cosine, i, j});
    }
  }
  return pairs;
}

}  // namespace

double CountSteps(const CurveSet& curves, double step) {
  double total = 0;
  for (const Curve& curve : curves.curves) total += Length(curve);
  return total / step;
}

std::vector<CurveStep> Resample(const CurveSet& curves, double step) {
  std::vector<CurveStep> steps;
  double start = 0;  // arc length at the start of the segment
  for (std::size_t c = 0; c < curves.curves.size(); ++c) {
    const std::vector<CurveSample>& samples = curves.curves[c].samples;
    const std::size_t n = samples.size();
    const std::size_t num_segments =
        n < 2 ? 0 : (curves.curves[c].closed ? n : n - 1);
    for (std::size_t i = 0; i < num_segments; ++i) {
      const Eigen::Vector3d& from = samples[i].position;
      const CurveSample& next = samples[(i + 1) % n];
      const Eigen::Vector3d along = next.position - from;
      const double length = along.norm();
      // Steps lie at (k + 1/2) step for k = steps.size().
      for (;;) {
        const double s = (static_cast<double>(steps.size()) + 0.5) * step;
        if (!(length > 0) || s >= start + length) break;
        const double t = (s - start) / length;
        const CurveKind kind = t < 0.5 ? samples[i].kind : next.kind;
        steps.push_back({from + t * along, along / length, c, kind});
      }
      start += length;
    }
  }
  return steps;
}

std::vector<int> SmoothGroups(const std::vector<TrueSample>& truth,
                              double max_gap) {
  const std::vector<TrueEnd> ends = FindEnds(truth);
  std::map<int, int> group_of;
  for (const EndChain& chain : FollowEnds(
           TieCheapestFirst(FindPairs(ends, max_gap), ends.size() / 2))) {
    int group = ends[2 * chain.items.front().item].curve_id;
    for (const ChainItem& link : chain.items) {
      group = std::min(group, ends[2 * link.item].curve_id);
    }
    for (const ChainItem& link : chain.items) {
      group_of[ends[2 * link.item].curve_id] = group;
    }
  }
  std::vector<int> groups;
  groups.reserve(truth.size());
  for (const TrueSample& sample : truth) {
    // Short curves have no ends.
    groups.push_back(
        group_of.emplace(sample.curve_id, sample.curve_id).first->second);
  }
  return groups;
}

}  // namespace curvix
