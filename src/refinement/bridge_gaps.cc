// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/bridge_gaps.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/point_tree.h"
#include "geometry/pixel_size.h"
#include "model/curve_chains.h"

namespace curvix {
namespace {

constexpr double kFittedPx = 15;
constexpr std::size_t kMinNumFitted = 5;
constexpr double kMaxMissPx = 1;
constexpr double kMaxMissPerGap = 0.1;
constexpr double kMaxAngleDeg = 15;
constexpr double kFillSpacingPx = 1.5;

// x(s) = position + s outward + s^2 bend / 2, s the way on beyond the end.
struct EndFit {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward = Eigen::Vector3d::UnitX();
  Eigen::Vector3d bend = Eigen::Vector3d::Zero();
  double length = 0;  // fitted, world units; 0: no end to join
  double pixel = 0;   // world units

  Eigen::Vector3d PointAt(double s) const {
    return position + s * outward + s * s / 2 * bend;
  }
  Eigen::Vector3d DirectionAt(double s) const {
    return (outward + s * bend).normalized();
  }
};

EndFit FitEnd(const Curve& curve,
              bool front,
              const std::vector<PosedView>& views) {
  const std::size_t size = curve.samples.size();
  const auto sample = [&](std::size_t k) -> const CurveSample& {
    return curve.samples[front ? size - 1 - k : k];
  };
  EndFit fit;
  fit.position = sample(0).position;
  fit.pixel = PixelSize(fit.position, sample(0).support, views);
  if (curve.closed || !(fit.pixel > 0)) return fit;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d right = Eigen::Matrix3d::Zero();
  double along = 0;
  std::size_t k = 0;
  for (; k < size; ++k) {
    if (k > 0) along += (sample(k).position - sample(k - 1).position).norm();
    if (along > kFittedPx * fit.pixel) break;
    const double s = -along / fit.pixel;
    const Eigen::Vector3d powers(1, s, s * s / 2);
    normal += powers * powers.transpose();
    right += powers * (sample(k).position - fit.position).transpose();
    fit.length = along;
  }
  const Eigen::Matrix3d parabola = normal.ldlt().solve(right) / fit.pixel;
  if (k < kMinNumFitted || !parabola.allFinite() ||
      !(parabola.row(1).norm() > 0)) {
    fit.length = 0;
    return fit;
  }
  fit.outward = parabola.row(1).transpose().normalized();
  fit.bend = parabola.row(2).transpose() / fit.pixel;
  return fit;
}

// Whether `from`, carried on, arrives at `to`.
bool Arrives(const EndFit& from, const EndFit& to, double gap, double unit) {
  const double miss = (from.PointAt(gap) - to.position).norm();
  const double cosine = from.DirectionAt(gap).dot(-to.outward);
  return miss <= kMaxMissPx * unit + kMaxMissPerGap * gap &&
         cosine >= std::cos(DegToRad(kMaxAngleDeg));
}

std::optional<double> JoinCost(const EndFit& a,
                               const EndFit& b,
                               const CurveRefinementOptions& options) {
  const double unit = std::min(a.pixel, b.pixel);
  const double gap = (b.position - a.position).norm();
  const double longest =
      std::min({options.max_gap_px * unit, a.length, b.length});
  if (!(gap > 0) || gap > longest || !Arrives(a, b, gap, unit) ||
      !Arrives(b, a, gap, unit)) {
    return std::nullopt;
  }
  return gap;
}

std::vector<EndPair> FindPairs(const std::vector<EndFit>& ends,
                               const CurveRefinementOptions& options) {
  std::vector<Eigen::Vector3d> positions;
  for (const EndFit& end : ends) positions.push_back(end.position);
  const PointTree tree(std::move(positions));
  std::vector<EndPair> pairs;
  for (EndIdx a = 0; a < ends.size(); ++a) {
    if (!(ends[a].length > 0)) continue;
    for (const EndIdx b :
         tree.Within(ends[a].position, options.max_gap_px * ends[a].pixel)) {
      if (b == a) continue;
      if (const auto cost = JoinCost(ends[a], ends[b], options)) {
        pairs.push_back({*cost, a, b});
      }
    }
  }
  return pairs;
}

// Samples on the cubic through both ends with their tangents.
std::vector<CurveSample> Fill(const CurveSample& from,
                              const CurveSample& to,
                              double spacing) {
  const double gap = (to.position - from.position).norm();
  const int num_pieces = static_cast<int>(gap / spacing) + 1;
  std::vector<CurveSample> filled;
  for (int k = 1; k < num_pieces; ++k) {
    const double u = static_cast<double>(k) / num_pieces;
    const double v = 1 - u;
    CurveSample& sample = filled.emplace_back();
    sample.position = (1 + 2 * u) * v * v * from.position +
                      (1 + 2 * v) * u * u * to.position +
                      gap * u * v * (v * from.tangent - u * to.tangent);
    sample.tangent = (v * from.tangent + u * to.tangent).normalized();
    sample.sigma = std::max(from.sigma, to.sigma);
    sample.evidence = std::min(from.evidence, to.evidence);
  }
  return filled;
}

}  // namespace

std::vector<Curve> BridgeGaps(std::vector<Curve> curves,
                              const std::vector<PosedView>& views,
                              const CurveRefinementOptions& options) {
  if (!(options.max_gap_px > 0)) return curves;
  std::vector<EndFit> ends;
  for (const Curve& curve : curves) {
    ends.push_back(FitEnd(curve, true, views));
    ends.push_back(FitEnd(curve, false, views));
  }
  const EndTies ties =
      TieCheapestFirst(FindPairs(ends, options), curves.size());
  return StringTogether(std::move(curves),
                        ties,
                        [&](const CurveSample& from, const CurveSample& to) {
                          const double pixel =
                              PixelSize(from.position, from.support, views);
                          return Fill(from, to, kFillSpacingPx * pixel);
                        });
}

}  // namespace curvix
