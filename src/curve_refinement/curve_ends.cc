// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/curve_ends.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "base/angles.h"
#include "geometry/adjust_edge.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

void Walk(const Curve& curve,
          int direction,
          double reach,
          std::vector<SampleAround>& around) {
  const std::size_t size = curve.samples.size();
  const std::size_t last = direction > 0 ? size - 1 : 0;
  std::size_t steps = curve.closed ? (size - 1) / 2 : size;
  double along = 0;
  for (std::size_t here = around.front().index; steps > 0; --steps) {
    if (!curve.closed && here == last) return;
    const std::size_t next =
        direction > 0 ? (here + 1) % size : (here + size - 1) % size;
    along +=
        (curve.samples[next].position - curve.samples[here].position).norm();
    if (along > reach) return;
    around.push_back({next, direction * along});
    here = next;
  }
}

}  // namespace

std::vector<SampleAround> SamplesAround(const Curve& curve,
                                        std::size_t index,
                                        double reach) {
  std::vector<SampleAround> around = {{index, 0}};
  Walk(curve, 1, reach, around);
  Walk(curve, -1, reach, around);
  return around;
}

Curve BranchTo(const Curve& curve,
               std::size_t last,
               bool with_direction,
               const BranchSegment& segment) {
  Curve branch;
  for (const SampleAround& around :
       SamplesAround(curve, last, segment.skipped + segment.length)) {
    const double away = with_direction ? -around.along : around.along;
    if (away < segment.skipped) continue;
    CurveSample& sample =
        branch.samples.emplace_back(curve.samples[around.index]);
    if (!with_direction) sample.tangent = -sample.tangent;
  }
  std::ranges::reverse(branch.samples);
  return branch;
}

double DistanceFromParabola(const Curve& from, const Curve& to) {
  const Eigen::Vector3d origin = from.samples.back().position;
  const Eigen::Vector3d way = to.samples.back().position - origin;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d right = Eigen::Matrix3d::Zero();
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> rows;
  for (const Curve* branch : {&from, &to}) {
    for (const CurveSample& sample : branch->samples) {
      const Eigen::Vector3d offset = sample.position - origin;
      const double t = offset.dot(way) / way.squaredNorm();
      const auto& [powers, position] =
          rows.emplace_back(Eigen::Vector3d(1, t, t * t), offset);
      normal += powers * powers.transpose();
      right += powers * position.transpose();
    }
  }
  const Eigen::Matrix3d parabola = normal.ldlt().solve(right);
  double sum = 0;
  for (const auto& [powers, position] : rows) {
    sum += (parabola.transpose() * powers - position).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

namespace {

constexpr std::size_t kMinNumFitted = 4;
constexpr int kNumFitRounds = 8;
constexpr double kScalePx = 0.3;  // of the robust weights
// A line is good enough while an arc takes less than this share of the sum of
// squares away.
constexpr double kLineShare = 0.5;

constexpr std::array kNearPx = {8.0, 12.0, 20.0};
constexpr double kMaxNearRmsPx = 0.06;
constexpr std::array kLongPx = {15.0, 25.0, 40.0, 60.0};
constexpr double kMaxLongRmsPx = 0.25;
constexpr double kMaxRmsRatio = 1.5;  // of the shortest

struct Placed {
  double along = 0;  // arc length, negative inside the curve
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  double weight = 1;
  // Of arcs of some curvature, see ArcBasis().
  Eigen::Vector2d basis = Eigen::Vector2d::Zero();
};

// sin(k s) / k and (1 - cos(k s)) / k^2, also for k = 0.
Eigen::Vector2d ArcBasis(double curvature, double s) {
  const double turn = curvature * s;
  if (std::abs(turn) < 1e-4) return {s, s * s / 2};
  return {std::sin(turn) / curvature,
          (1 - std::cos(turn)) / (curvature * curvature)};
}

std::vector<Placed> Take(const Curve& curve,
                         bool at_head,
                         const EndSegment& segment,
                         double pixel) {
  const auto position = [&](std::size_t k) -> const Eigen::Vector3d& {
    return SampleFromEnd(curve, at_head, k).position;
  };
  std::vector<Placed> placed;
  double along = 0;
  for (std::size_t k = 0; k < curve.samples.size(); ++k) {
    if (k > 0) along += (position(k) - position(k - 1)).norm();
    if (along > segment.end_px * pixel) break;
    if (along < segment.begin_px * pixel) continue;
    Placed& sample = placed.emplace_back();
    sample.along = -along;
    sample.offset = position(k) - position(0);
  }
  return placed;
}

void SetBases(double curvature, std::vector<Placed>& placed) {
  for (Placed& p : placed) p.basis = ArcBasis(curvature, p.along);
}

// Rows: place, direction and bend at arc length 0 of the arc that fits best, if
// its curvature is that of the bases.
Eigen::Matrix3d SolveArc(const std::vector<Placed>& placed) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d right = Eigen::Matrix3d::Zero();
  for (const Placed& p : placed) {
    Eigen::Vector3d basis;
    basis << 1, p.basis;
    normal += p.weight * basis * basis.transpose();
    right += p.weight * basis * p.offset.transpose();
  }
  return normal.ldlt().solve(right);
}

Eigen::Matrix3d SolveLine(const std::vector<Placed>& placed) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 2, 3> right = Eigen::Matrix<double, 2, 3>::Zero();
  for (const Placed& p : placed) {
    const Eigen::Vector2d basis(1, p.along);
    normal += p.weight * basis * basis.transpose();
    right += p.weight * basis * p.offset.transpose();
  }
  Eigen::Matrix3d rows = Eigen::Matrix3d::Zero();
  rows.topRows<2>() = normal.ldlt().solve(right);
  return rows;
}

Eigen::Vector3d PointOf(const EndFit& fit, const Eigen::Vector2d& basis) {
  return fit.position + basis.x() * fit.outward + basis.y() * fit.bend;
}

// From a sample to the fit; its basis must be of the fit's curvature.
Eigen::Vector3d OffsetToFit(const EndFit& fit,
                            const Eigen::Vector3d& last,
                            const Placed& p) {
  return PointOf(fit, p.basis) - last - p.offset;
}

// Samples further off than `scale` count little (Cauchy).
void Reweight(const EndFit& fit,
              const Eigen::Vector3d& last,
              double scale,
              std::vector<Placed>& placed) {
  for (Placed& p : placed) {
    p.weight = CauchyWeight(OffsetToFit(fit, last, p).norm(), scale);
  }
}

// Of the weighted distances.
double MeanSquare(const EndFit& fit,
                  const Eigen::Vector3d& last,
                  const std::vector<Placed>& placed) {
  double sum = 0, weights = 0;
  for (const Placed& p : placed) {
    sum += p.weight * OffsetToFit(fit, last, p).squaredNorm();
    weights += p.weight;
  }
  return sum / weights;
}

// False if the rows are no curve.
bool SetFrom(const Eigen::Matrix3d& rows,
             const Eigen::Vector3d& last,
             EndFit& fit) {
  if (!rows.allFinite() || !(rows.row(1).norm() > 0)) return false;
  fit.position = last + rows.row(0).transpose();
  fit.outward = rows.row(1).transpose().normalized();
  const Eigen::Vector3d bend = rows.row(2).transpose();
  fit.bend = bend - bend.dot(fit.outward) * fit.outward;
  return true;
}

}  // namespace

Eigen::Vector3d EndFit::PointAt(double arc_length) const {
  return PointOf(*this, ArcBasis(bend.norm(), arc_length));
}

Eigen::Vector3d EndFit::DirectionAt(double arc_length) const {
  const double curvature = bend.norm();
  const double turn = curvature * arc_length;
  return (std::cos(turn) * outward + ArcBasis(curvature, arc_length).x() * bend)
      .normalized();
}

double EndFit::ArcLengthTo(const Eigen::Vector3d& point) const {
  const double curvature = bend.norm();
  const Eigen::Vector3d offset = point - position;
  const double ahead = offset.dot(outward);
  if (!(curvature * offset.norm() > 1e-6)) return ahead;
  const double towards = 1 / curvature - offset.dot(bend) / curvature;
  const double turn = std::atan2(ahead, towards);
  constexpr double kMaxTurn = kPi / 2;
  return std::clamp(turn, -kMaxTurn, kMaxTurn) / curvature;
}

EndFit FitEnd(const Curve& curve,
              bool at_head,
              const EndSegment& segment,
              const std::vector<PosedView>& views) {
  const CurveSample& last = SampleFromEnd(curve, at_head);
  EndFit fit;
  fit.position = last.position;
  fit.pixel = PixelSize(last, views);
  if (curve.closed || !(fit.pixel > 0)) return fit;
  std::vector<Placed> placed = Take(curve, at_head, segment, fit.pixel);
  if (placed.size() < kMinNumFitted) return fit;
  EndFit arc = fit;
  SetBases(0, placed);
  for (int round = 0; round < kNumFitRounds; ++round) {
    if (!SetFrom(SolveArc(placed), last.position, arc)) return fit;
    SetBases(arc.bend.norm(), placed);
    // Strong bends look like outliers at first.
    if (round < kNumFitRounds / 2) continue;
    Reweight(arc, last.position, kScalePx * fit.pixel, placed);
  }
  const double arc_square = MeanSquare(arc, last.position, placed);
  EndFit line = fit;
  if (!SetFrom(SolveLine(placed), last.position, line)) return fit;
  SetBases(0, placed);
  const double line_square = MeanSquare(line, last.position, placed);
  // An arc has a parameter more.
  const auto size = static_cast<double>(placed.size());
  const bool is_arc =
      arc_square / (size - 3) < kLineShare * line_square / (size - 2);
  fit = is_arc ? arc : line;
  fit.rms = std::sqrt(is_arc ? arc_square : line_square);
  fit.length = -placed.back().along;
  return fit;
}

namespace {

// Of ever longer segments the last whose fit leaves at most max_rms_px, or
// about as little as the first.
EndFit FitLongest(const Curve& curve,
                  bool at_head,
                  const std::vector<EndSegment>& segments,
                  double max_rms_px,
                  const std::vector<PosedView>& views) {
  EndFit best;
  double max_rms = 0;
  const double length = Length(curve);
  for (const EndSegment& segment : segments) {
    const EndFit fit = FitEnd(curve, at_head, segment, views);
    if (!(best.length > 0)) {
      best = fit;
      max_rms = std::max(max_rms_px * fit.pixel, kMaxRmsRatio * fit.rms);
    } else if (fit.length > best.length && fit.rms <= max_rms) {
      best = fit;
    }
    // Longer segments have the same samples.
    if (segment.end_px * fit.pixel > length) break;
  }
  return best;
}

}  // namespace

EndFit FitNearEnd(const Curve& curve,
                  bool at_head,
                  double skipped_px,
                  double cut_px,
                  const std::vector<PosedView>& views) {
  std::vector<EndSegment> segments;
  for (const double near_px : kNearPx) {
    segments.push_back({skipped_px, near_px - cut_px});
  }
  return FitLongest(curve, at_head, segments, kMaxNearRmsPx, views);
}

EndFit FitLongEnd(const Curve& curve,
                  bool at_head,
                  const std::vector<PosedView>& views) {
  std::vector<EndSegment> segments;
  for (const double long_px : kLongPx)
    segments.push_back({kBentEndPx, long_px});
  return FitLongest(curve, at_head, segments, kMaxLongRmsPx, views);
}

}  // namespace curvix
