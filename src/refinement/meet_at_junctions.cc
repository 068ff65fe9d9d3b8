// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/meet_at_junctions.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <tuple>

#include "base/angles.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

constexpr double kRoundedPx = 2.5;  // bent by a corner
constexpr double kFittedPx = 12;    // along which a line is fitted
constexpr std::size_t kMinNumFitted = 4;
constexpr double kMinCornerDeg = 20;

// One open end of a curve and the line on which it continues.
struct CurveEnd {
  std::size_t curve_idx = 0;
  bool at_back = false;
  Eigen::Vector3d position;   // of the last sample
  Eigen::Vector3d direction;  // unit, out of the curve
  Eigen::Vector3d origin;     // on the line, next to the last sample
  double pixel = 0;           // world units per pixel
  double length = 0;          // of the fitted samples, world units
};

// The direction in which points scatter most.
Eigen::Vector3d PrincipalDirection(const std::vector<Eigen::Vector3d>& points,
                                   const Eigen::Vector3d& mean) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    scatter += (point - mean) * (point - mean).transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter)
      .eigenvectors()
      .col(2);
}

std::optional<CurveEnd> FitEnd(const Curve& curve,
                               std::size_t curve_idx,
                               bool at_back,
                               const std::vector<PosedView>& views) {
  const std::size_t size = curve.samples.size();
  const auto sample = [&](std::size_t k) -> const CurveSample& {
    return curve.samples[at_back ? size - 1 - k : k];
  };
  CurveEnd end;
  end.curve_idx = curve_idx;
  end.at_back = at_back;
  end.position = sample(0).position;
  end.pixel = PixelSize(end.position, sample(0).support, views);
  if (!(end.pixel > 0)) return std::nullopt;
  std::vector<Eigen::Vector3d> fitted;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double along = 0;
  for (std::size_t k = 0; k < size; ++k) {
    if (k > 0) along += (sample(k).position - sample(k - 1).position).norm();
    if (along > kFittedPx * end.pixel) break;
    if (along < kRoundedPx * end.pixel) continue;
    fitted.push_back(sample(k).position);
    end.length = along;
    mean += sample(k).position;
  }
  if (fitted.size() < kMinNumFitted) return std::nullopt;
  mean /= static_cast<double>(fitted.size());
  end.direction = PrincipalDirection(fitted, mean);
  if (end.direction.dot(end.position - mean) < 0) end.direction *= -1;
  end.origin = mean + end.direction.dot(end.position - mean) * end.direction;
  return end;
}

std::vector<CurveEnd> FitEnds(const std::vector<Curve>& curves,
                              const std::vector<PosedView>& views) {
  std::vector<CurveEnd> ends;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (curves[i].closed) continue;
    for (const bool at_back : {false, true}) {
      if (auto end = FitEnd(curves[i], i, at_back, views)) {
        ends.push_back(*end);
      }
    }
  }
  return ends;
}

// The point with the least sum of squared distances from the ends' lines. Lines
// that are all parallel have none.
std::optional<Eigen::Vector3d> NearestToLines(
    const std::vector<CurveEnd>& ends,
    const std::vector<std::size_t>& members) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const Eigen::Vector3d base = ends[members.front()].origin;
  for (const std::size_t i : members) {
    const Eigen::Vector3d& d = ends[i].direction;
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - d * d.transpose();
    normal += across;
    right += across * (ends[i].origin - base);
  }
  // The least eigenvalue of two lines at angle a is 1 - cos a.
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(normal).eigenvalues()(0);
  if (least < 1 - std::cos(DegToRad(kMinCornerDeg))) return std::nullopt;
  return base + normal.ldlt().solve(right);
}

// Largest distance, in pixels, between the lines and `point`; nullopt if the
// point is out of reach of an end.
std::optional<double> GapAt(const std::vector<CurveEnd>& ends,
                            const std::vector<std::size_t>& members,
                            const Eigen::Vector3d& point,
                            double reach_px) {
  double gap = 0;
  for (const std::size_t i : members) {
    const CurveEnd& end = ends[i];
    const Eigen::Vector3d offset = point - end.origin;
    const double ahead = offset.dot(end.direction);
    if (std::abs(ahead) > std::min(reach_px * end.pixel, end.length)) {
      return std::nullopt;
    }
    gap = std::max(gap, (offset - ahead * end.direction).norm() / end.pixel);
  }
  return gap;
}

struct Junction {
  std::vector<std::size_t> members;  // ends
  Eigen::Vector3d point;
  double gap_px = 0;
};

std::optional<Junction> MakeJunction(const std::vector<CurveEnd>& ends,
                                     std::vector<std::size_t> members,
                                     const CurveRefinementOptions& options) {
  const auto point = NearestToLines(ends, members);
  if (!point) return std::nullopt;
  const auto gap = GapAt(ends, members, *point, options.junction_reach_px);
  if (!gap || *gap > options.max_junction_gap_px) return std::nullopt;
  return Junction{std::move(members), *point, *gap};
}

std::vector<Junction> FindPairs(const std::vector<CurveEnd>& ends,
                                const CurveRefinementOptions& options) {
  std::vector<Junction> pairs;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      const double reach = 2 * options.junction_reach_px *
                           std::min(ends[i].pixel, ends[j].pixel);
      if ((ends[i].position - ends[j].position).norm() > reach) continue;
      if (auto pair = MakeJunction(ends, {i, j}, options)) {
        pairs.push_back(*std::move(pair));
      }
    }
  }
  std::sort(
      pairs.begin(), pairs.end(), [](const Junction& a, const Junction& b) {
        return std::tie(a.gap_px, a.members) < std::tie(b.gap_px, b.members);
      });
  return pairs;
}

// Pairs by rising gap; a free end may still join the junction of the other one.
std::vector<Junction> FormJunctions(const std::vector<CurveEnd>& ends,
                                    const CurveRefinementOptions& options) {
  std::vector<Junction> junctions;
  std::vector<std::optional<std::size_t>> junction_of(ends.size());
  for (const Junction& pair : FindPairs(ends, options)) {
    const std::size_t i = pair.members[0], j = pair.members[1];
    if (junction_of[i] && junction_of[j]) continue;
    if (!junction_of[i] && !junction_of[j]) {
      junction_of[i] = junction_of[j] = junctions.size();
      junctions.push_back(pair);
      continue;
    }
    const std::size_t free = junction_of[i] ? j : i;
    const std::size_t idx = junction_of[i] ? *junction_of[i] : *junction_of[j];
    std::vector<std::size_t> members = junctions[idx].members;
    members.push_back(free);
    if (auto larger = MakeJunction(ends, std::move(members), options)) {
      junction_of[free] = idx;
      junctions[idx] = *std::move(larger);
    }
  }
  return junctions;
}

// Cuts the bent end off and adds the junction.
void CarryOn(const CurveEnd& end,
             const Eigen::Vector3d& junction,
             Curve& curve) {
  std::vector<CurveSample>& samples = curve.samples;
  if (!end.at_back) std::reverse(samples.begin(), samples.end());
  CurveSample last = samples.back();
  const double limit =
      (junction - end.origin).dot(end.direction) - kRoundedPx * end.pixel;
  while (samples.size() > 2 &&
         (samples.back().position - end.origin).dot(end.direction) >
             std::min(limit, -kRoundedPx * end.pixel)) {
    samples.pop_back();
  }
  last.position = junction;
  last.tangent = (end.at_back ? 1.0 : -1.0) * end.direction;
  samples.push_back(std::move(last));
  if (!end.at_back) std::reverse(samples.begin(), samples.end());
}

}  // namespace

std::vector<Curve> MeetAtJunctions(std::vector<Curve> curves,
                                   const std::vector<PosedView>& views,
                                   const CurveRefinementOptions& options) {
  if (!(options.junction_reach_px > 0)) return curves;
  const std::vector<CurveEnd> ends = FitEnds(curves, views);
  for (const Junction& junction : FormJunctions(ends, options)) {
    for (const std::size_t i : junction.members) {
      CarryOn(ends[i], junction.point, curves[ends[i].curve_idx]);
    }
  }
  return curves;
}

}  // namespace curvix
