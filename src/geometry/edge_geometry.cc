// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/edge_geometry.h"

#include <Eigen/Geometry>
#include <cmath>

namespace curvix {

Eigen::Vector3d EdgePlane(const PosedView& view, const ImageEdge& edge) {
  const Eigen::Vector2d normal = edge.Normal();
  const Eigen::Vector3d line(
      normal.x(), normal.y(), -normal.dot(edge.position));
  return view.rotation.transpose() * (view.calibration.transpose() * line);
}

std::optional<SpaceEdge> TriangulateEdge(const PosedView& view1,
                                         const ImageEdge& edge1,
                                         const PosedView& view2,
                                         const ImageEdge& edge2,
                                         double min_ray_angle_rad,
                                         double min_plane_angle_rad) {
  const Eigen::Vector3d ray1 = view1.Ray(edge1.position).normalized();
  const Eigen::Vector3d ray2 = view2.Ray(edge2.position).normalized();
  const Eigen::Vector3d baseline = view2.center - view1.center;
  // Nearest points of C1 + a ray1 and C2 + b ray2.
  const double cosine = ray1.dot(ray2);
  const double sine2 = 1 - cosine * cosine;
  const double min_sine = std::sin(min_ray_angle_rad);
  if (!(sine2 > min_sine * min_sine)) return std::nullopt;
  const double a = (baseline.dot(ray1) - cosine * baseline.dot(ray2)) / sine2;
  const double b = (cosine * baseline.dot(ray1) - baseline.dot(ray2)) / sine2;
  if (!(a > 0) || !(b > 0)) return std::nullopt;

  const Eigen::Vector3d tangent =
      EdgePlane(view1, edge1)
          .normalized()
          .cross(EdgePlane(view2, edge2).normalized());
  const double plane_sine = tangent.norm();
  if (!(plane_sine > std::sin(min_plane_angle_rad))) return std::nullopt;
  return SpaceEdge{view1.center + a * ray1, tangent / plane_sine};
}

}  // namespace curvix
