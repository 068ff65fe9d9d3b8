// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/marker_corners.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr double kMaxDistancePx = 2;
constexpr double kMaxAngleDeg = 15;
constexpr double kLeftOut = 0.1;  // of a side, at either end
constexpr std::size_t kMinEdges = 5;
constexpr double kOutlierPx = 0.5;

struct ImageLine {
  Eigen::Vector2d point;
  Eigen::Vector2d normal;  // unit

  double DistanceOf(const Eigen::Vector2d& p) const {
    return normal.dot(p - point);
  }
};

ImageLine FitLineTo(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : points) {
    scatter += (p - mean) * (p - mean).transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(scatter);
  return {mean, eigen.eigenvectors().col(0)};
}

// Through the edges along a side, twice: the second time without outliers.
std::optional<ImageLine> LineOfSide(const Eigen::Vector2d& from,
                                    const Eigen::Vector2d& to,
                                    const std::vector<Edge2d>& edges) {
  const Eigen::Vector2d side = to - from;
  const double angle = std::atan2(side.y(), side.x());
  const Eigen::Vector2d along = side / side.squaredNorm();
  const Eigen::Vector2d normal =
      Eigen::Vector2d(-side.y(), side.x()).normalized();
  std::vector<Eigen::Vector2d> points;
  for (const Edge2d& edge : edges) {
    const Eigen::Vector2d offset = edge.position - from;
    const double at = along.dot(offset);
    if (std::abs(normal.dot(offset)) < kMaxDistancePx && at > kLeftOut &&
        at < 1 - kLeftOut &&
        UndirectedDifference(edge.angle, angle) < DegToRad(kMaxAngleDeg)) {
      points.push_back(edge.position);
    }
  }
  if (points.size() < kMinEdges) return std::nullopt;
  const ImageLine first = FitLineTo(points);
  std::erase_if(points, [&](const Eigen::Vector2d& p) {
    return std::abs(first.DistanceOf(p)) > kOutlierPx;
  });
  if (points.size() < kMinEdges) return std::nullopt;
  return FitLineTo(points);
}

}  // namespace

std::optional<SeenMarker> CornersFromSides(const SeenMarker& marker,
                                           const Camera& camera,
                                           const std::vector<Edge2d>& edges) {
  const Eigen::Matrix3d calibration = PinholeCalibration(camera);
  const Eigen::Matrix3d inverse = calibration.inverse();
  std::array<Eigen::Vector2d, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto uv = IdealFromImage(camera, marker.corners[k]);
    if (!uv) return std::nullopt;
    corners[k] = (calibration * uv->homogeneous()).hnormalized();
  }
  std::array<std::optional<ImageLine>, 4> sides;
  for (std::size_t k = 0; k < 4; ++k) {
    sides[k] = LineOfSide(corners[k], corners[(k + 1) % 4], edges);
    if (!sides[k]) return std::nullopt;
  }
  SeenMarker refined = marker;
  for (std::size_t k = 0; k < 4; ++k) {
    const ImageLine& before = *sides[(k + 3) % 4];
    const ImageLine& after = *sides[k];
    Eigen::Matrix2d normals;
    normals << before.normal.transpose(), after.normal.transpose();
    const Eigen::Vector2d corner =
        normals.inverse() * Eigen::Vector2d(before.normal.dot(before.point),
                                            after.normal.dot(after.point));
    const Eigen::Vector3d ray = inverse * corner.homogeneous();
    refined.corners[k] = ImageFromIdeal(camera, ray.hnormalized());
    if (!refined.corners[k].allFinite()) return std::nullopt;
  }
  return refined;
}

}  // namespace curvix
