// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/drawing_plane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/angles.h"
#include "geometry/directions.h"

namespace curvix {
namespace {

constexpr double kInPlaneDeg = 1.5;
constexpr double kLevelDeg = 10;

// The length of a line, if it lies across `normal`; else 0.
double LengthAcross(const CurveFit& fit, const Eigen::Vector3d& normal) {
  if (fit.kind != FitKind::kLine) return 0;
  const Eigen::Vector3d chord = fit.end - fit.start;
  const double length = chord.norm();
  return std::abs(chord.dot(normal)) < std::sin(DegToRad(kInPlaneDeg)) * length
             ? length
             : 0;
}

// Of the range between the quartiles of depths, how much is one plane.
constexpr double kMainDepthWidth = 0.1;

// Of the length in the plane with most, what the nearest needs to be taken.
constexpr double kNearlyMost = 0.8;

using WeightedDepths = std::vector<std::pair<double, double>>;

// Below which `share` of `total` is; of depths that are sorted.
double Quantile(const WeightedDepths& depths, double total, double share) {
  double sum = 0;
  for (const auto& [depth, weight] : depths) {
    sum += weight;
    if (sum >= share * total) return depth;
  }
  return depths.back().first;
}

}  // namespace

std::optional<DrawingPlane> AxisPlane(std::string_view name) {
  const auto x = Eigen::Vector3d::UnitX();
  const auto y = Eigen::Vector3d::UnitY();
  const auto z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (name == "xy") return DrawingPlane{"xy", origin, x, y, z, z, "z"};
  if (name == "xz") return DrawingPlane{"xz", origin, x, z, -y, y, "y"};
  if (name == "yz") return DrawingPlane{"yz", origin, y, z, x, x, "x"};
  return std::nullopt;
}

DrawingPlane FromBehind(DrawingPlane plane) {
  plane.right = -plane.right;
  plane.toward = -plane.toward;
  plane.is_from_behind = !plane.is_from_behind;
  return plane;
}

Result<DrawingPlane> PlaneThrough(const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c,
                                  const Eigen::Vector3d& up,
                                  const Eigen::Vector3d& views_direction) {
  constexpr double kOnALine = 1e-6;  // radians
  const double angle = AngleBetween(b - a, c - a);
  if (!(angle > kOnALine && angle < kPi - kOnALine)) {
    return Status::InvalidArgument(
        "the three points are on a line, which is in many planes");
  }
  DrawingPlane plane;
  plane.origin = a;
  plane.toward = (b - a).cross(c - a).normalized();
  if (plane.toward.dot(views_direction) > 0) plane.toward = -plane.toward;
  const double from_up = AngleBetween(plane.toward, up);
  const double level = DegToRad(kLevelDeg);
  if (from_up < level || from_up > kPi - level || up.isZero(0)) {
    plane.right = (b - a).normalized();
    plane.up = plane.toward.cross(plane.right);
  } else {
    plane.up = (up - up.dot(plane.toward) * plane.toward).normalized();
    plane.right = plane.up.cross(plane.toward);
  }
  plane.depth_axis = plane.toward;
  return plane;
}

DrawingPlane MainPlane(const FittedCurves& fitted,
                       const Eigen::Matrix3d& axes,
                       const std::vector<View>& views) {
  std::vector<DrawingPlane> planes;
  for (const char* name : {"xz", "xy", "yz"}) {
    DrawingPlane& plane = planes.emplace_back(*AxisPlane(name));
    for (Eigen::Vector3d* const v :
         {&plane.right, &plane.up, &plane.toward, &plane.depth_axis}) {
      *v = axes * *v;
    }
  }
  // In front of each, less those behind, and all.
  std::array<int, 3> balance = {}, count = {};
  for (const View& view : views) {
    const Eigen::Vector3d along =
        view.cam_from_world.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    std::size_t faced = 0;
    for (std::size_t i = 1; i < planes.size(); ++i) {
      const double cosine = std::abs(planes[i].toward.dot(along));
      if (cosine > std::abs(planes[faced].toward.dot(along))) faced = i;
    }
    ++count[faced];
    balance[faced] += planes[faced].toward.dot(along) < 0 ? 1 : -1;
  }
  std::array<double, 3> length = {};
  std::size_t best = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (const FittedCurve& curve : fitted.curves) {
      for (const CurveFit& fit : curve.fits) {
        length[i] += LengthAcross(fit, planes[i].toward);
      }
    }
    if (std::pair(count[i], length[i]) > std::pair(count[best], length[best])) {
      best = i;
    }
  }
  return balance[best] < 0 ? FromBehind(planes[best]) : planes[best];
}

double MainDepth(const FittedCurves& fitted,
                 const DrawingPlane& plane,
                 double low,
                 double high) {
  // From the viewer on, so that depths grow away from the viewer.
  const double away = plane.depth_axis.dot(plane.toward) > 0 ? -1 : 1;
  WeightedDepths depths;
  double total = 0;
  // Of lines that lie in the plane; without any, of everything.
  for (const bool all : {false, true}) {
    if (!depths.empty()) break;
    for (const FittedCurve& curve : fitted.curves) {
      for (const CurveFit& fit : curve.fits) {
        const double length =
            all ? Length(fit) : LengthAcross(fit, plane.toward);
        const double depth = plane.Depth((fit.start + fit.end) / 2);
        if (!(length > 0 && depth >= low && depth <= high)) continue;
        depths.emplace_back(away * depth, length);
        total += length;
      }
    }
  }
  if (depths.empty()) return std::clamp(0.0, low, high);
  std::ranges::sort(depths);
  const double width = kMainDepthWidth * (Quantile(depths, total, 0.75) -
                                          Quantile(depths, total, 0.25));
  std::vector<double> lengths;  // in a plane that begins at each depth
  double within = 0;
  std::size_t end = 0;
  for (const auto& [depth, length] : depths) {
    while (end < depths.size() && depths[end].first <= depth + width) {
      within += depths[end++].second;
    }
    lengths.push_back(within);
    within -= length;
  }
  const double most = *std::ranges::max_element(lengths);
  const auto nearest = std::ranges::find_if(
      lengths, [&](double length) { return length >= kNearlyMost * most; });
  return away *
         Quantile({depths.begin() + (nearest - lengths.begin()), depths.end()},
                  *nearest,
                  0.5);
}

}  // namespace curvix
