// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/epipolar.h"

#include <Eigen/Geometry>
#include <numeric>

#include "base/infinity.h"
#include "geometry/directions.h"

namespace curvix {

std::optional<EpipolarPencil> EpipolarPencil::Make(const PosedView& view1,
                                                   const PosedView& view2) {
  const Eigen::Vector3d baseline = view2.center - view1.center;
  const double length = baseline.norm();
  if (!(length > 1e-12 * (view1.center.norm() + view2.center.norm()))) {
    return std::nullopt;
  }
  EpipolarPencil pencil;
  pencil.baseline_ = baseline / length;
  pencil.u_ = pencil.baseline_.unitOrthogonal();
  pencil.v_ = pencil.baseline_.cross(pencil.u_);
  return pencil;
}

EpipolarAngles::EpipolarAngles(const EpipolarPencil& pencil,
                               const PosedView& view) {
  const Eigen::Matrix3d from_world =
      view.calibration.inverse().transpose() * view.rotation;
  along_u_ = from_world * pencil.u_;
  along_v_ = from_world * pencil.v_;
  along_baseline_ = from_world * pencil.baseline_;
}

std::optional<EpipolarAngle> EpipolarAngles::AngleOf(
    const Eigen::Vector2d& pixel) const {
  const Eigen::Vector3d p = pixel.homogeneous();
  const double x = along_u_.dot(p);
  const double y = along_v_.dot(p);
  const double z = along_baseline_.dot(p);
  const double radius2 = x * x + y * y;
  constexpr double kMinSine = 0.0087;  // of half a degree
  if (radius2 < kMinSine * kMinSine * (radius2 + z * z)) return std::nullopt;
  // d angle = (x dy - y dx) / radius^2.
  const Eigen::Vector2d per_px =
      x * along_v_.head<2>() - y * along_u_.head<2>();
  return EpipolarAngle{std::atan2(y, x), per_px.norm() / radius2};
}

Eigen::Matrix3d FundamentalMatrix(const PosedView& view1,
                                  const PosedView& view2) {
  const Eigen::Matrix3d rotation = view2.rotation * view1.rotation.transpose();
  const Eigen::Vector3d translation =
      view2.translation - rotation * view1.translation;
  return view2.calibration.inverse().transpose() * CrossMatrix(translation) *
         rotation * view1.calibration.inverse();
}

Line2 EpipolarLine(const Eigen::Matrix3d& fundamental,
                   const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d line = fundamental * pixel.homogeneous();
  const double length = line.head<2>().norm();
  return {line.head<2>() / length, line.z() / length};
}

RayProjection::RayProjection(const PosedView& view1, const PosedView& view2)
    : at_infinity_(view2.calibration * view2.rotation *
                   view1.rotation.transpose() * view1.calibration.inverse()),
      epipole_(view2.calibration * view2.InCamera(view1.center)) {}

Interval RayProjection::SeenAlong(const Line2& line,
                                  const Eigen::Vector2d& pixel,
                                  double nearest,
                                  double farthest) const {
  const Eigen::Vector3d ray = at_infinity_ * pixel.homogeneous();
  const Eigen::Vector3d near_end = nearest * ray + epipole_;
  const Eigen::Vector3d far_end = ray + epipole_ / farthest;
  if (!(near_end.z() > 0) || !(far_end.z() > 0)) return {-kInfinity, kInfinity};
  const double a = line.Direction().dot(near_end.hnormalized());
  const double b = line.Direction().dot(far_end.hnormalized());
  return {std::min(a, b), std::max(a, b)};
}

std::optional<Wedge> WedgeOf(const EpipolarAngles& angles,
                             const Eigen::Vector2d& pixel,
                             double tolerance_px) {
  const auto angle = angles.AngleOf(pixel);
  if (!angle) return std::nullopt;
  return Wedge{angle->angle, tolerance_px * angle->rad_per_px};
}

bool Meet(const Wedge& a, const Wedge& b) {
  return std::abs(std::remainder(a.center - b.center, 2 * kPi)) <=
         a.half_width + b.half_width;
}

SortedByAngle::SortedByAngle(const EpipolarAngles& angles,
                             const std::vector<Edge2d>& edges,
                             double tolerance_px) {
  std::vector<Entry> entries;
  entries.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto wedge = WedgeOf(angles, edges[i].position, tolerance_px);
    if (!wedge) continue;
    entries.push_back({*wedge, static_cast<std::int32_t>(i)});
    max_half_width_ = std::max(max_half_width_, wedge->half_width);
  }
  if (entries.empty()) return;
  const auto [least, largest] =
      std::ranges::minmax_element(entries, {}, &Entry::center);
  const auto size = static_cast<double>(entries.size());
  least_angle_ = least->center;
  if (largest->center > least_angle_) {
    buckets_per_rad_ = size / (largest->center - least_angle_);
  }
  // Counting sort.
  begins_.assign(entries.size() + 1, 0);
  for (const Entry& entry : entries) ++begins_[Bucket(entry.center) + 1];
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  entries_.resize(entries.size());
  for (const Entry& entry : entries) {
    entries_[next[Bucket(entry.center)]++] = entry;
  }
}

std::vector<std::int32_t> SortedByAngle::Meeting(const Wedge& wedge) const {
  std::vector<std::int32_t> found;
  VisitMeeting(wedge,
               [&](std::int32_t edge_idx) { found.push_back(edge_idx); });
  std::ranges::sort(found);
  return found;
}

}  // namespace curvix
