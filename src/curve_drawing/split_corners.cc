// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering), after Sec. 6. Curves end at corners.
#include "curve_drawing/group_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "geometry/directions.h"
#include "geometry/pixel_size.h"

namespace curvix {
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
