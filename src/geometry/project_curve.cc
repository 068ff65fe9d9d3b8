// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves in the images of views.
#include <curvix/curves.h>
#include <curvix/scene.h>
#include <Eigen/Geometry>
#include <cstddef>
#include <utility>

namespace curvix {

std::optional<Eigen::Vector2d> ProjectPoint(const Eigen::Vector3d& point,
                                            const View& view,
                                            const Camera& camera) {
  constexpr double kMinCosine = 0.17;  // of 80 degrees
  constexpr double kSameUv = 1e-4;
  const Eigen::Vector3d in_camera = view.cam_from_world * point;
  if (!(in_camera.z() > kMinCosine * in_camera.norm())) return std::nullopt;
  const Eigen::Vector2d uv = in_camera.hnormalized();
  const Eigen::Vector2d pixel = ImageFromIdeal(camera, uv);
  const bool inside = pixel.x() >= 0 && pixel.x() <= camera.width &&
                      pixel.y() >= 0 && pixel.y() <= camera.height;
  if (!inside) return std::nullopt;  // NaN, too
  if (IsPinhole(camera)) return pixel;
  const auto back = IdealFromImage(camera, pixel);
  if (!back || (*back - uv).norm() > kSameUv) return std::nullopt;
  return pixel;
}

std::vector<std::vector<Eigen::Vector2d>> ProjectCurve(const Curve& curve,
                                                       const View& view,
                                                       const Camera& camera) {
  std::vector<std::vector<Eigen::Vector2d>> segments;
  std::vector<Eigen::Vector2d> segment;
  const auto finish = [&] {
    if (segment.size() > 1) segments.push_back(std::move(segment));
    segment.clear();
  };
  const std::size_t size = curve.samples.size();
  for (std::size_t i = 0; i < size + (curve.closed ? 1 : 0); ++i) {
    const auto pixel =
        ProjectPoint(curve.samples[i % size].position, view, camera);
    if (pixel) {
      segment.push_back(*pixel);
    } else {
      finish();
    }
  }
  finish();
  return segments;
}

}  // namespace curvix
