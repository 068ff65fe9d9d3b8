// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Edges from the image to its ideal pinhole.
#include "edge_detection/undistort_edges.h"

#include <curvix/camera_model.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/check.h"

namespace curvix {
namespace {

std::optional<Edge2d> UndistortEdge(const Edge2d& edge,
                                    const Camera& camera,
                                    const Eigen::Matrix3d& calibration) {
  const std::optional<Eigen::Vector2d> ideal =
      IdealFromImage(camera, edge.position);
  if (!ideal) return std::nullopt;
  const Eigen::Matrix2d image_from_ideal =
      ImageFromIdealJacobian(camera, *ideal);
  if (!(image_from_ideal.determinant() > 0)) return std::nullopt;
  const Eigen::Vector2d tangent(std::cos(edge.angle), std::sin(edge.angle));
  const Eigen::Vector2d ideal_tangent =
      calibration.topLeftCorner<2, 2>() * image_from_ideal.inverse() * tangent;
  Edge2d undistorted = edge;
  undistorted.position = (calibration * ideal->homogeneous()).head<2>();
  undistorted.angle =
      static_cast<float>(std::atan2(ideal_tangent.y(), ideal_tangent.x()));
  return undistorted;
}

using NewIndices = std::vector<std::optional<std::int32_t>>;

std::optional<std::int32_t> Renumbered(const NewIndices& new_idx,
                                       std::optional<std::int32_t> old_idx) {
  if (!old_idx) return std::nullopt;
  return new_idx[static_cast<std::size_t>(*old_idx)];
}

}  // namespace

EdgeMap UndistortEdges(EdgeMap distorted, const Camera& camera) {
  CURVIX_CHECK(distorted.edges.size() == distorted.neighbors.size(),
               distorted.edges.size() << " edges");
  if (IsPinhole(camera)) return distorted;
  const Eigen::Matrix3d calibration = PinholeCalibration(camera);
  EdgeMap ideal;
  ideal.noise = distorted.noise;
  ideal.spacing_px = distorted.spacing_px;
  ideal.num_dropped_isolated = distorted.num_dropped_isolated;
  ideal.num_dropped_over_limit = distorted.num_dropped_over_limit;
  ideal.num_dropped_masked = distorted.num_dropped_masked;
  NewIndices new_idx(distorted.edges.size());
  for (std::size_t i = 0; i < distorted.edges.size(); ++i) {
    const std::optional<Edge2d> edge =
        UndistortEdge(distorted.edges[i], camera, calibration);
    if (!edge) continue;
    new_idx[i] = static_cast<std::int32_t>(ideal.edges.size());
    ideal.edges.push_back(*edge);
  }
  ideal.neighbors.reserve(ideal.edges.size());
  for (std::size_t i = 0; i < distorted.edges.size(); ++i) {
    if (!new_idx[i]) continue;
    const EdgeNeighbors& links = distorted.neighbors[i];
    ideal.neighbors.push_back(
        {Renumbered(new_idx, links.previous), Renumbered(new_idx, links.next)});
  }
  return ideal;
}

}  // namespace curvix
