// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3. Oriented edges from two views to space and from space to a
// view.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "model/posed_view.h"

namespace curvix {

// Where an oriented edge lies in an image. `tangent` is unit and sign-free.
struct ImageEdge {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // pixels
  Eigen::Vector2d tangent = Eigen::Vector2d::UnitX();

  // The tangent, turned from x to y by 90 degrees.
  Eigen::Vector2d Normal() const { return {-tangent.y(), tangent.x()}; }
};

// An oriented edge in space. `tangent` is unit and sign-free.
struct SpaceEdge {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();
};

// The plane through the camera centre and an edge's tangent line, as the vector
// w for which w . (X - center) / depth(X) is the signed distance, in pixels, of
// the projection of X from the tangent line, positive on the side to which
// edge.Normal() points.
Eigen::Vector3d EdgePlane(const PosedView& view, const ImageEdge& edge);

// The edge in space whose projections are edge1 and edge2. The position lies on
// the ray of edge1, nearest to that of edge2. nullopt when a ray has negative
// depth, when the rays are less than min_ray_angle_rad from parallel, or the
// two edge planes are less than min_plane_angle_rad apart: both edges run along
// the epipolar line and have no tangent in space.
std::optional<SpaceEdge> TriangulateEdge(const PosedView& view1,
                                         const ImageEdge& edge1,
                                         const PosedView& view2,
                                         const ImageEdge& edge2,
                                         double min_ray_angle_rad,
                                         double min_plane_angle_rad);

// The direction in the image of a step along `tangent` (world) from `x_cam`, in
// front of the camera: not normalised, zero for steps towards the camera.
inline Eigen::Vector2d TangentInImage(const PosedView& view,
                                      const Eigen::Vector3d& x_cam,
                                      const Eigen::Vector3d& tangent) {
  // The projection's derivative times the squared depth; fx and fy may differ.
  const Eigen::Vector3d t = view.rotation * tangent;
  return {view.calibration(0, 0) * (t.x() * x_cam.z() - x_cam.x() * t.z()),
          view.calibration(1, 1) * (t.y() * x_cam.z() - x_cam.y() * t.z())};
}

// nullopt behind the camera or when the tangent points at the camera.
inline std::optional<ImageEdge> ProjectEdge(const PosedView& view,
                                            const SpaceEdge& edge) {
  const Eigen::Vector3d x = view.InCamera(edge.position);
  if (!(x.z() > 0)) return std::nullopt;
  const Eigen::Vector2d tangent = TangentInImage(view, x, edge.tangent);
  const double length = tangent.norm();
  // The image of a unit step, relative to that of a step across the ray.
  if (!(length > 1e-3 * x.z() * view.calibration(0, 0))) return std::nullopt;
  return ImageEdge{view.Pixel(x), tangent / length};
}

// The same, and nullopt outside the image.
inline std::optional<ImageEdge> ProjectInto(const PosedView& view,
                                            const SpaceEdge& edge) {
  auto projected = ProjectEdge(view, edge);
  if (!projected || !view.Contains(projected->position)) return std::nullopt;
  return projected;
}

}  // namespace curvix
