// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What curves and points near a place say.
#include "curve_kinds/strips.h"

#include <algorithm>
#include <cstddef>

#include "base/angles.h"
#include "base/infinity.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Nearer points may be of the same edge.
constexpr double kMinDistancePx = 3;
// The share of points that lie on neither surface.
constexpr double kElsewhere = 0.3;
// Standard deviation of the direction of a point on a surface: 15 degrees, or
// that of so many pixels.
constexpr double kDirectionSigma = kPi / 12;
constexpr double kPointSigmaPx = 0.7;
// Points nearby are not independent: they count as at most so many.
constexpr double kMaxPoints = 6;

// Of other curves, places at most as far along the tangent, in pixels, are
// beside a place. Nearer ones show the same edge.
constexpr double kMaxAlongPx = 6;
constexpr double kMinBesidePx = 1;

struct Direction {
  double angle = 0;  // about the tangent, from the normal, radians
  double sigma = 0;
  double peak = 0;  // largest Ratio()
};

// Of the `points` that are not too near, from where a surface begins, both in
// pixels across the curve.
std::vector<Direction> DirectionsFrom(const Vector2d& begin,
                                      const std::vector<Vector2d>& points) {
  std::vector<Direction> directions;
  directions.reserve(points.size());
  for (const Vector2d& point : points) {
    const Vector2d offset = point - begin;
    const double distance_px = offset.norm();
    if (distance_px < kMinDistancePx) continue;
    const double sigma =
        std::hypot(kDirectionSigma, kPointSigmaPx / distance_px);
    directions.push_back({std::atan2(offset.y(), offset.x()),
                          sigma,
                          kPi / (sigma * std::sqrt(2 * kPi))});
  }
  return directions;
}

// Whether most cameras see the direction on side 0. Directions are those of
// StripPlace::Across(), to the cameras too.
bool IsOnFirstSide(const Vector2d& direction,
                   const std::vector<Vector2d>& cameras) {
  const auto num = std::ranges::count_if(cameras, [&](const Vector2d& camera) {
    return camera.x() * direction.y() > camera.y() * direction.x();
  });
  return 2 * num > static_cast<std::ptrdiff_t>(cameras.size());
}

// The density of the direction of a point on a surface that leads in direction
// `angle`, from 0 to 2 pi, over that of any direction on this side.
double Ratio(const Direction& point, double angle) {
  double apart = point.angle - angle;
  if (apart < -kPi) apart += 2 * kPi;
  const double z = apart / point.sigma;
  return point.peak * std::exp(-z * z / 2);
}

}  // namespace

CurveDistances DistancesByDirection(const StripPlace& place,
                                    double pixel,
                                    const std::vector<Vector3d>& positions) {
  CurveDistances distances;
  distances.fill(kInfinity);
  for (const Vector3d& position : positions) {
    const Vector3d offset = (position - place.position) / pixel;
    const double distance = place.Across(offset).norm();
    if (std::abs(offset.dot(place.tangent)) > kMaxAlongPx ||
        distance < kMinBesidePx) {
      continue;
    }
    // The directions to either side of the exact one.
    const double steps =
        place.AngleOf(offset) / (2 * kPi) * kNumDirections + kNumDirections;
    for (const double step : {std::floor(steps), std::floor(steps) + 1}) {
      double& nearest =
          distances[static_cast<std::size_t>(step) % kNumDirections];
      nearest = std::min(nearest, pixel * distance);
    }
  }
  return distances;
}

void AddNearbyPoints(const StripPlace& place,
                     double pixel,
                     const std::vector<PosedView>& views,
                     const std::vector<Vector3d>& points,
                     double depth,
                     SurfaceEvidence* evidence) {
  std::vector<Vector2d> cameras;
  for (const int view : place.views) {
    const Vector3d& center = views[static_cast<std::size_t>(view)].center;
    cameras.push_back(place.Across(center - place.position));
  }
  std::array<std::vector<Vector2d>, 2> sides;
  for (const Vector3d& point : points) {
    const Vector2d across = place.Across(point - place.position);
    if (across.norm() < kMinDistancePx * pixel) continue;
    sides[IsOnFirstSide(across, cameras) ? 0 : 1].push_back(across / pixel);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    if (sides[side].empty()) continue;
    const auto num = static_cast<double>(sides[side].size());
    const double weight = std::min(1.0, kMaxPoints / num);
    std::vector<Direction> from = DirectionsFrom({0, 0}, sides[side]);
    for (int d = 0; d < kNumDirections; ++d) {
      float& log_bayes = evidence->log_bayes[side][static_cast<std::size_t>(d)];
      if (!std::isfinite(log_bayes)) continue;
      const double angle = d * 2 * kPi / kNumDirections;
      if (depth > 0) {
        from = DirectionsFrom(depth / pixel * AwayFromCameras(angle, side),
                              sides[side]);
      }
      double sum = 0;
      for (const Direction& point : from) {
        sum += std::log(kElsewhere + (1 - kElsewhere) * Ratio(point, angle));
      }
      log_bayes += static_cast<float>(weight * sum);
    }
  }
}

}  // namespace curvix
