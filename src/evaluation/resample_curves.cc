// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/resample_curves.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/angles.h"

namespace curvix {
namespace {

double TotalLength(const CurveSet& curves) {
  double total = 0;
  for (const Curve& curve : curves.curves) total += Length(curve);
  return total;
}

}  // namespace

double CountSteps(const CurveSet& curves, double step) {
  return TotalLength(curves) / step;
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

namespace {

struct CurveEnd {
  int curve_id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();  // unit, or zero
};

struct EndPair {
  double cosine = 0;  // of the outward directions; -1 goes straight on
  std::size_t first = 0;
  std::size_t second = 0;
};

CurveEnd MakeEnd(int curve_id,
                 const Eigen::Vector3d& end,
                 const Eigen::Vector3d& inside) {
  const Eigen::Vector3d outward = end - inside;
  return {curve_id, end, outward / std::max(outward.norm(), 1e-15)};
}

// Both ends of each curve of at least three samples, by curve id.
std::vector<CurveEnd> FindEnds(const std::vector<TrueSample>& truth) {
  std::map<int, std::vector<Eigen::Vector3d>> curves;
  for (const TrueSample& sample : truth) {
    curves[sample.curve_id].push_back(sample.position);
  }
  std::vector<CurveEnd> ends;
  for (const auto& [id, points] : curves) {
    const std::size_t n = points.size();
    if (n < 3) continue;
    ends.push_back(MakeEnd(id, points[0], points[2]));
    ends.push_back(MakeEnd(id, points[n - 1], points[n - 3]));
  }
  return ends;
}

// Pairs of ends that continue each other, the straightest first.
std::vector<EndPair> FindPairs(const std::vector<CurveEnd>& ends,
                               double max_gap) {
  const double min_cosine = std::cos(DegToRad(15));
  std::vector<EndPair> pairs;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      if ((ends[i].position - ends[j].position).norm() >= max_gap) continue;
      const double cosine = ends[i].outward.dot(ends[j].outward);
      if (-cosine > min_cosine) pairs.push_back({cosine, i, j});
    }
  }
  const auto straighter = [](const EndPair& a, const EndPair& b) {
    return a.cosine < b.cosine;
  };
  std::stable_sort(pairs.begin(), pairs.end(), straighter);
  return pairs;
}

int FindRoot(const std::map<int, int>& parent, int id) {
  while (parent.at(id) != id) id = parent.at(id);
  return id;
}

}  // namespace

std::vector<int> SmoothGroups(const std::vector<TrueSample>& truth,
                              double max_gap) {
  std::map<int, int> parent;
  for (const TrueSample& sample : truth) {
    parent[sample.curve_id] = sample.curve_id;
  }
  const std::vector<CurveEnd> ends = FindEnds(truth);
  std::vector<char> used(ends.size(), 0);
  for (const EndPair& pair : FindPairs(ends, max_gap)) {
    if (used[pair.first] || used[pair.second]) continue;
    used[pair.first] = used[pair.second] = 1;
    const int a = FindRoot(parent, ends[pair.first].curve_id);
    const int b = FindRoot(parent, ends[pair.second].curve_id);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<int> groups;
  groups.reserve(truth.size());
  for (const TrueSample& sample : truth) {
    groups.push_back(FindRoot(parent, sample.curve_id));
  }
  return groups;
}

}  // namespace curvix
