// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering), after Sec. 6. Curves are drawn once, small gaps
// are closed, and curves end at corners.
#include "curve_drawing/group_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/point_tree.h"
#include "curve_drawing/link_edges.h"
#include "geometry/directions.h"
#include "geometry/pixel_size.h"
#include "model/sample_ranges.h"

namespace curvix {
namespace {

// Samples of one curve that are no more apart than this never repeat each
// other.
constexpr std::size_t kMinLoop = 6;

bool AreNeighbors(const SamplePlace& a,
                  const SamplePlace& b,
                  const std::vector<Curve>& curves) {
  if (a.curve_idx != b.curve_idx) return false;
  const std::size_t gap = std::max(a.sample_idx, b.sample_idx) -
                          std::min(a.sample_idx, b.sample_idx);
  const Curve& curve = curves[a.curve_idx];
  return gap < kMinLoop ||
         (curve.closed && curve.samples.size() - gap < kMinLoop);
}

// Curve indices by decreasing length.
std::vector<std::size_t> ByLength(const std::vector<Curve>& curves,
                                  const std::vector<PosedView>& views) {
  std::vector<double> lengths;
  for (const Curve& curve : curves) {
    lengths.push_back(LengthInPixels(curve, views));
  }
  std::vector<std::size_t> order(curves.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, std::greater<>(), [&](std::size_t c) { return lengths[c]; });
  return order;
}

}  // namespace

std::vector<Curve> DropDuplicates(std::vector<Curve> curves,
                                  const std::vector<PosedView>& views,
                                  const ConnectivityOptions& options) {
  if (!(options.max_duplicate_distance_px > 0)) return curves;
  const SampleTree samples(curves);
  const auto sample_at = [&](const SamplePlace& place) -> const CurveSample& {
    return curves[place.curve_idx].samples[place.sample_idx];
  };
  // By curve and sample: whether it was visited and stays.
  std::vector<std::vector<bool>> stays;
  for (const Curve& curve : curves) {
    stays.emplace_back(curve.samples.size(), false);
  }
  const auto is_duplicate = [&](const SamplePlace& place) {
    const CurveSample& sample = sample_at(place);
    const double unit = PixelSize(sample, views);
    const double max_normal = options.max_duplicate_distance_px * unit;
    const double max_along = options.sample_spacing_px * unit;
    const std::vector<std::size_t> near =
        samples.Within(sample.position, std::hypot(max_normal, max_along));
    return std::ranges::any_of(near, [&](std::size_t i) {
      const SamplePlace& other = samples.Places()[i];
      if (!stays[other.curve_idx][other.sample_idx] ||
          AreNeighbors(place, other, curves)) {
        return false;
      }
      const EdgeDistances between = MeasureDistances(sample, sample_at(other));
      return between.normal <= max_normal && between.tangential <= max_along &&
             between.angle <= DegToRad(options.max_angle_deg);
    });
  };
  for (const std::size_t c : ByLength(curves, views)) {
    for (std::size_t s = 0; s < curves[c].samples.size(); ++s) {
      stays[c][s] = !is_duplicate({c, s});
    }
  }
  std::vector<Curve> kept;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    std::ranges::move(KeepRanges(std::move(curves[c]), std::move(stays[c]), 1),
                      std::back_inserter(kept));
  }
  return kept;
}

namespace {

// Samples at an end whose mean tangent is its direction.
constexpr std::size_t kNumEndSamples = 3;

struct JoinableEnd {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward = Eigen::Vector3d::UnitX();  // unit
  double pixel_size = 0;  // 0: closed, no end at all
};

JoinableEnd EndOf(const Curve& curve,
                  bool at_head,
                  const std::vector<PosedView>& views) {
  const CurveSample& last = SampleFromEnd(curve, at_head);
  const double sign = at_head ? 1 : -1;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < std::min(kNumEndSamples, curve.samples.size());
       ++k) {
    sum += sign * SampleFromEnd(curve, at_head, k).tangent;
  }
  return {last.position,
          sum.normalized(),
          curve.closed ? 0 : PixelSize(last, views)};
}

// The cost of joining two ends; nullopt if they do not continue each other.
std::optional<double> JoinCost(const JoinableEnd& a,
                               const JoinableEnd& b,
                               const ConnectivityOptions& options) {
  const double unit = std::min(a.pixel_size, b.pixel_size);
  const Eigen::Vector3d offset = b.position - a.position;
  const double gap = offset.norm();
  const double normal =
      std::max(a.outward.cross(offset).norm(), b.outward.cross(offset).norm());
  const double angle = std::max({AngleBetween(a.outward, offset),
                                 AngleBetween(-b.outward, offset),
                                 AngleBetween(a.outward, -b.outward)});
  if (!(unit > 0) || !(gap > 0) || gap > options.max_gap_px * unit ||
      normal > kMaxNormalDistancePx * unit ||
      angle > DegToRad(options.max_angle_deg)) {
    return std::nullopt;
  }
  return gap + normal;
}

std::vector<EndPair> FindPairs(const std::vector<JoinableEnd>& ends,
                               const ConnectivityOptions& options) {
  const PointTree tree(ends, &JoinableEnd::position);
  std::vector<EndPair> pairs;
  for (EndIdx a = 0; a < ends.size(); ++a) {
    const double radius = options.max_gap_px * ends[a].pixel_size;
    for (const EndIdx b : tree.Within(ends[a].position, radius)) {
      if (b == a) continue;
      const auto cost = JoinCost(ends[a], ends[b], options);
      if (cost.has_value()) pairs.push_back({*cost, a, b});
    }
  }
  return pairs;
}

}  // namespace

std::vector<Curve> JoinCurves(std::vector<Curve> curves,
                              const std::vector<PosedView>& views,
                              const ConnectivityOptions& options) {
  if (!(options.max_gap_px > 0)) return curves;
  std::vector<JoinableEnd> ends;
  for (EndIdx end = 0; end < 2 * curves.size(); ++end) {
    ends.push_back(EndOf(curves[ItemOf(end)], IsHead(end), views));
  }
  const EndTies ties =
      TieCheapestFirst(FindPairs(ends, options), curves.size());
  return StringTogether(std::move(curves), ties, {});
}

namespace {

constexpr double kBranchBegin = 3;  // pixels from the corner
constexpr double kBranchEnd = 9;    // pixels from the corner
constexpr std::size_t kMinBranchSamples = 4;
// Of the turn between the branches, within kBranchBegin of the corner. Waves
// turn all along.
constexpr double kMinTurnShare = 0.5;

// The directions of one branch, all along the curve.
struct Branch {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double bend = 0;  // between its halves, radians
};

// A curve with the length of each step in pixels.
class CornerFinder {
 public:
  CornerFinder(const Curve& curve, const std::vector<PosedView>& views)
      : curve_(curve) {
    const std::size_t size = curve.samples.size();
    for (std::size_t k = 0; k < size; ++k) {
      const CurveSample& a = curve.samples[k];
      const CurveSample& b = curve.samples[(k + 1) % size];
      const double unit = PixelSize(a, views);
      const double step = (b.position - a.position).norm();
      steps_px_.push_back(unit > 0 ? step / unit : 0);
    }
  }

  // The samples after which the curve is to be cut, ascending.
  std::vector<std::size_t> Corners(double max_turn) const {
    std::vector<double> turns(steps_px_.size());
    for (std::size_t k = 0; k < turns.size(); ++k) turns[k] = Turn(k);
    std::vector<std::size_t> corners;
    for (std::size_t k = 0; k < turns.size(); ++k) {
      if (turns[k] <= max_turn || !IsSharpest(turns, k)) continue;
      const std::size_t corner = SharpestNear(k);
      const double between_branches =
          AngleBetween(BranchAt(k, false)->mean, BranchAt(k, true)->mean);
      if (TurnAtCut(corner) >= kMinTurnShare * between_branches) {
        corners.push_back(corner);
      }
    }
    std::ranges::sort(corners);
    return corners;
  }

 private:
  // The sample after `k` (forward) or before it, and the way there in pixels.
  std::optional<std::pair<std::size_t, double>> Next(std::size_t k,
                                                     bool forward) const {
    const std::size_t size = steps_px_.size();
    if (!curve_.closed && k == (forward ? size - 1 : 0)) return std::nullopt;
    const std::size_t next = (forward ? k + 1 : k + size - 1) % size;
    return std::pair(next, steps_px_[forward ? k : next]);
  }

  // Calls visit(index, distance) for samples up to kBranchEnd away, in order.
  template <typename Visit>
  void Walk(std::size_t from, bool forward, const Visit& visit) const {
    double distance = 0;
    auto next = Next(from, forward);
    while (next.has_value() && next->first != from) {
      distance += next->second;
      if (distance > kBranchEnd) return;
      visit(next->first, distance);
      next = Next(next->first, forward);
    }
  }

  std::optional<Branch> BranchAt(std::size_t k, bool forward) const {
    std::size_t num_samples = 0;
    Eigen::Vector3d near = Eigen::Vector3d::Zero();
    Eigen::Vector3d far = Eigen::Vector3d::Zero();
    Walk(k, forward, [&](std::size_t i, double distance) {
      if (distance < kBranchBegin) return;
      ++num_samples;
      (2 * distance < kBranchBegin + kBranchEnd ? near : far) +=
          curve_.samples[i].tangent;
    });
    if (num_samples < kMinBranchSamples || near.isZero() || far.isZero()) {
      return std::nullopt;
    }
    return Branch{near + far, AngleBetween(near, far)};
  }

  // The excess turn at sample `k`, radians; 0 where there are no branches.
  double Turn(std::size_t k) const {
    const auto ahead = BranchAt(k, true);
    const auto behind = BranchAt(k, false);
    if (!ahead.has_value() || !behind.has_value()) return 0;
    // Branch centres are this many times further apart than halves of a
    // branch.
    const double ratio =
        2 * (kBranchEnd + kBranchBegin) / (kBranchEnd - kBranchBegin);
    return AngleBetween(behind->mean, ahead->mean) -
           ratio * std::min(ahead->bend, behind->bend);
  }

  bool IsSharpest(const std::vector<double>& turns, std::size_t k) const {
    bool is_sharpest = true;
    for (const bool forward : {true, false}) {
      Walk(k, forward, [&](std::size_t i, double) {
        if (turns[i] > turns[k] || (turns[i] == turns[k] && i < k)) {
          is_sharpest = false;
        }
      });
    }
    return is_sharpest;
  }

  // Between the mean directions right before and right after the cut.
  double TurnAtCut(std::size_t k) const {
    Eigen::Vector3d before = curve_.samples[k].tangent;
    Eigen::Vector3d after = Eigen::Vector3d::Zero();
    Walk(k, true, [&](std::size_t i, double distance) {
      if (distance <= kBranchBegin) after += curve_.samples[i].tangent;
    });
    Walk(k, false, [&](std::size_t i, double distance) {
      if (distance < kBranchBegin) before += curve_.samples[i].tangent;
    });
    return AngleBetween(before, after);
  }

  std::size_t SharpestNear(std::size_t corner) const {
    std::pair best(-TurnAtCut(corner), corner);
    for (const bool forward : {true, false}) {
      Walk(corner, forward, [&](std::size_t i, double distance) {
        if (distance > kBranchBegin) return;
        best = std::min(best, std::pair(-TurnAtCut(i), i));
      });
    }
    return best.second;
  }

  const Curve& curve_;
  std::vector<double> steps_px_;  // from each sample to the next
};

}  // namespace

std::vector<Curve> SplitCorners(const std::vector<Curve>& curves,
                                const std::vector<PosedView>& views,
                                const ConnectivityOptions& options) {
  std::vector<Curve> split;
  for (const Curve& curve : curves) {
    const auto corners =
        CornerFinder(curve, views).Corners(DegToRad(options.max_corner_deg));
    std::ranges::move(CutAfter(curve, corners), std::back_inserter(split));
  }
  return split;
}

}  // namespace curvix
