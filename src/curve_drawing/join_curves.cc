// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering), after Sec. 6. Small gaps closed.
#include "curve_drawing/group_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/point_tree.h"
#include "geometry/directions.h"
#include "geometry/pixel_size.h"

namespace curvix {
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

}  // namespace curvix
