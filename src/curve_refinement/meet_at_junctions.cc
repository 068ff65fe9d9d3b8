// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Sharp corners.
#include "curve_refinement/refine_curves.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>

#include "base/angles.h"
#include "base/parallel.h"
#include "base/point_tree.h"
#include "curve_refinement/curve_ends.h"
#include "geometry/pixel_size.h"
#include "model/curve_chains.h"

namespace curvix {
namespace {

constexpr double kShortRoundedPx = 0.5;  // of curves that are hardly longer
// Where the fit leaves more, the bend of the end cannot be told.
constexpr double kMaxEndRmsPx = 0.25;
constexpr double kMinCornerDeg = 10;
// Largest distance of a continued end from its corner. Pixels.
constexpr double kMaxJunctionGapPx = 1.5;
constexpr int kNumMeetingRounds = 3;
constexpr double kMeetingStepPx = 1.5;

// One open end of a curve and how it goes on.
struct CurveEnd {
  EndIdx idx = 0;
  EndFit fit;
};

struct Line {
  Eigen::Vector3d direction;  // unit
  Eigen::Vector3d origin;     // on the line
};

std::vector<CurveEnd> FitEnds(const std::vector<Curve>& curves,
                              const RefinementInput& input) {
  std::vector<std::vector<CurveEnd>> ends(curves.size());
  ParallelFor(curves.size(), input.num_threads, [&](std::size_t i) {
    for (const EndIdx end : {2 * i + 1, 2 * i}) {
      const bool at_head = IsHead(end);
      EndFit fit = FitNearEnd(curves[i], at_head, kRoundedPx, 0, input.views);
      if (!(fit.length > 0)) {
        fit = FitNearEnd(curves[i], at_head, kShortRoundedPx, 0, input.views);
      }
      if (fit.length > 0 && fit.rms <= kMaxEndRmsPx * fit.pixel) {
        ends[i].push_back({end, fit});
      }
    }
  });
  return Concatenate(std::move(ends));
}

// Without those of curves that were cut where they touch others: two ends in
// one place that continue each other.
std::vector<CurveEnd> WithoutTouches(const std::vector<CurveEnd>& ends,
                                     const std::vector<Curve>& curves) {
  using Place = std::array<double, 3>;
  std::map<Place, std::vector<Eigen::Vector3d>> directions;
  const auto place_of = [&](const CurveEnd& end) {
    const Eigen::Vector3d& last =
        SampleFromEnd(curves[ItemOf(end.idx)], IsHead(end.idx)).position;
    return Place{last.x(), last.y(), last.z()};
  };
  for (const CurveEnd& end : ends) {
    directions[place_of(end)].push_back(end.fit.outward);
  }
  std::vector<CurveEnd> others;
  for (const CurveEnd& end : ends) {
    const auto& here = directions[place_of(end)];
    if (std::ranges::none_of(here, [&](const auto& direction) {
          return -direction.dot(end.fit.outward) >
                 std::cos(DegToRad(kMinCornerDeg));
        })) {
      others.push_back(end);
    }
  }
  return others;
}

using Members = std::vector<std::size_t>;  // indices of ends

// The point with the least sum of squared distances from the lines. Lines that
// are all parallel have none.
std::optional<Eigen::Vector3d> NearestToLines(const std::vector<Line>& lines) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const Eigen::Vector3d base = lines.front().origin;
  for (const Line& line : lines) {
    const Eigen::Vector3d& d = line.direction;
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - d * d.transpose();
    normal += across;
    right += across * (line.origin - base);
  }
  // The least eigenvalue of two lines at angle a is 1 - cos a.
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(normal).eigenvalues()(0);
  if (least < 1 - std::cos(DegToRad(kMinCornerDeg))) return std::nullopt;
  return base + normal.ldlt().solve(right);
}

// Largest distance, in pixels, between the lines on which the members go on and
// `point`; nullopt if the point is out of reach of a member.
std::optional<double> GapAt(const Eigen::Vector3d& point,
                            const std::vector<CurveEnd>& ends,
                            const Members& members,
                            const std::vector<Line>& lines,
                            double reach_px) {
  double gap = 0;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const EndFit& fit = ends[members[k]].fit;
    const double reach = std::min(reach_px * fit.pixel, fit.length);
    if ((point - fit.position).norm() > reach) return std::nullopt;
    const Eigen::Vector3d offset = point - lines[k].origin;
    gap = std::max(gap, lines[k].direction.cross(offset).norm() / fit.pixel);
  }
  return gap;
}

struct Junction {
  Members members;
  Eigen::Vector3d point;
  double gap_px = 0;
};

// Bent curves meet where their tangents there do: a fixed point.
std::optional<Junction> MakeJunction(const std::vector<CurveEnd>& ends,
                                     Members members,
                                     double reach_px) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (const std::size_t i : members) {
    point += ends[i].fit.position / static_cast<double>(members.size());
  }
  std::vector<Line> lines(members.size());
  for (int round = 0; round < kNumMeetingRounds; ++round) {
    for (std::size_t k = 0; k < members.size(); ++k) {
      const EndFit& fit = ends[members[k]].fit;
      const double arc_length = fit.ArcLengthTo(point);
      lines[k] = {fit.DirectionAt(arc_length), fit.PointAt(arc_length)};
    }
    const auto nearest = NearestToLines(lines);
    if (!nearest) return std::nullopt;
    point = *nearest;
  }
  const auto gap = GapAt(point, ends, members, lines, reach_px);
  if (!gap || *gap > kMaxJunctionGapPx) return std::nullopt;
  return Junction{std::move(members), point, *gap};
}

// Whether `end` may join `members`. Both ends of a curve that is not `is_long`
// would make a spike of it.
bool MayJoin(std::size_t end,
             const Members& members,
             const std::vector<CurveEnd>& ends,
             const std::vector<bool>& is_long) {
  const std::size_t curve = ItemOf(ends[end].idx);
  return is_long[curve] || std::ranges::none_of(members, [&](std::size_t i) {
           return ItemOf(ends[i].idx) == curve;
         });
}

std::vector<Junction> FindPairs(const std::vector<CurveEnd>& ends,
                                const std::vector<bool>& is_long,
                                const RefinementInput& input) {
  const double reach_px = input.options.junction_reach_px;
  const PointTree tree(ends,
                       [](const CurveEnd& end) { return end.fit.position; });
  std::vector<std::vector<Junction>> pairs_of(ends.size());
  ParallelFor(ends.size(), input.num_threads, [&](std::size_t i) {
    const EndFit& a = ends[i].fit;
    const auto reach = [&](const EndFit& b) {
      return 2 * reach_px * std::min(a.pixel, b.pixel);
    };
    for (const std::size_t j : tree.Within(a.position, reach(a))) {
      const EndFit& b = ends[j].fit;
      if (j <= i || (a.position - b.position).norm() > reach(b) ||
          !MayJoin(j, {i}, ends, is_long)) {
        continue;
      }
      if (auto pair = MakeJunction(ends, {i, j}, reach_px)) {
        pairs_of[i].push_back(*std::move(pair));
      }
    }
  });
  std::vector<Junction> pairs = Concatenate(std::move(pairs_of));
  std::ranges::sort(pairs, {}, [](const Junction& pair) {
    return std::tie(pair.gap_px, pair.members);
  });
  return pairs;
}

// Pairs by rising gap; a free end may still join the junction of the other one.
std::vector<Junction> FormJunctions(const std::vector<CurveEnd>& ends,
                                    const std::vector<bool>& is_long,
                                    const RefinementInput& input) {
  std::vector<Junction> junctions;
  std::vector<std::optional<std::size_t>> junction_of(ends.size());
  for (const Junction& pair : FindPairs(ends, is_long, input)) {
    const std::size_t i = pair.members[0], j = pair.members[1];
    if (junction_of[i] && junction_of[j]) continue;
    if (!junction_of[i] && !junction_of[j]) {
      junction_of[i] = junction_of[j] = junctions.size();
      junctions.push_back(pair);
      continue;
    }
    const std::size_t free = junction_of[i] ? j : i;
    const std::size_t idx = junction_of[i] ? *junction_of[i] : *junction_of[j];
    Members members = junctions[idx].members;
    if (!MayJoin(free, members, ends, is_long)) continue;
    members.push_back(free);
    if (auto larger = MakeJunction(
            ends, std::move(members), input.options.junction_reach_px)) {
      junction_of[free] = idx;
      junctions[idx] = *std::move(larger);
    }
  }
  return junctions;
}

// Cuts the bent end off and carries it on to the junction.
void CarryOn(const CurveEnd& end,
             const Eigen::Vector3d& junction,
             Curve& curve) {
  const EndFit& fit = end.fit;
  const bool at_head = IsHead(end.idx);
  CurveSample last = SampleFromEnd(curve, at_head);
  last.support.clear();  // its edges are those of the bend
  const double arrival = fit.ArcLengthTo(junction);
  const double limit = std::min(arrival, 0.0) - kRoundedPx * fit.pixel;
  CutEnd(curve, at_head, [&](const CurveSample& sample) {
    return fit.ArcLengthTo(sample.position) <= limit;
  });
  const double start = fit.ArcLengthTo(SampleFromEnd(curve, at_head).position);
  const int num_steps = std::max(
      1, static_cast<int>((arrival - start) / (kMeetingStepPx * fit.pixel)));
  const Eigen::Vector3d miss = junction - fit.PointAt(arrival);
  const double sign = at_head ? 1 : -1;
  std::vector<CurveSample> added;
  for (int k = 1; k <= num_steps; ++k) {
    const double share = static_cast<double>(k) / num_steps;
    const double arc_length = start + share * (arrival - start);
    last.position =
        k == num_steps
            ? junction
            : Eigen::Vector3d(fit.PointAt(arc_length) + share * miss);
    last.tangent = sign * fit.DirectionAt(arc_length);
    added.push_back(last);
  }
  if (!at_head) std::ranges::reverse(added);
  curve.samples.insert(at_head ? curve.samples.end() : curve.samples.begin(),
                       added.begin(),
                       added.end());
}

}  // namespace

std::vector<Curve> MeetAtJunctions(std::vector<Curve> curves,
                                   const RefinementInput& input) {
  const double reach_px = input.options.junction_reach_px;
  if (!(reach_px > 0)) return curves;
  const std::vector<CurveEnd> ends =
      WithoutTouches(FitEnds(curves, input), curves);
  std::vector<bool> is_long;  // enough for a loop
  for (const Curve& curve : curves) {
    is_long.push_back(LengthInPixels(curve, input.views) > 4 * reach_px);
  }
  for (const Junction& junction : FormJunctions(ends, is_long, input)) {
    for (const std::size_t i : junction.members) {
      CarryOn(ends[i], junction.point, curves[ItemOf(ends[i].idx)]);
    }
  }
  return curves;
}

}  // namespace curvix
