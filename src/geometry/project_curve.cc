// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves in the images of views.
#include <curvix/curves.h>
#include <curvix/scene.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <utility>

namespace curvix {
namespace {

// Which samples the view shows: those that it supports, and gaps of fewer than
// kMaxGap.
std::vector<bool> AreShown(const Curve& curve, int view_idx) {
  constexpr std::size_t kMaxGap = 20;
  const auto is_supported = [&](const CurveSample& sample) {
    return std::ranges::any_of(sample.support, [&](const EdgeRef& ref) {
      return ref.view_idx == view_idx;
    });
  };
  const std::size_t size = curve.samples.size();
  std::vector<bool> are_shown(size);
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < (curve.closed ? 2 : 1) * size; ++i) {
    if (!is_supported(curve.samples[i % size])) continue;
    const bool goes_on = last && i - *last <= kMaxGap;
    for (std::size_t k = goes_on ? *last : i; k <= i; ++k) {
      are_shown[k % size] = true;
    }
    last = i;
  }
  return are_shown;
}

// A segment is shown if both its samples are.
std::vector<ProjectedStretch> Project(const Curve& curve,
                                      const std::vector<bool>& are_shown,
                                      const View& view,
                                      const Camera& camera) {
  const std::size_t size = curve.samples.size();
  std::vector<std::optional<Eigen::Vector2d>> pixels;
  for (const CurveSample& sample : curve.samples) {
    pixels.push_back(ProjectPoint(sample.position, view, camera));
  }
  std::vector<ProjectedStretch> stretches;
  bool goes_on = false;  // the last stretch ends at sample i
  for (std::size_t i = 0; i + (curve.closed ? 0 : 1) < size; ++i) {
    const std::size_t next = (i + 1) % size;
    const bool is_visible = pixels[i] && pixels[next];
    if (is_visible) {
      const bool is_shown = are_shown[i] && are_shown[next];
      if (!goes_on || stretches.back().is_shown != is_shown) {
        stretches.push_back({{*pixels[i]}, is_shown});
      }
      stretches.back().pixels.push_back(*pixels[next]);
    }
    goes_on = is_visible;
  }
  return stretches;
}

}  // namespace

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
  const std::vector<bool> none_shown(curve.samples.size());
  std::vector<std::vector<Eigen::Vector2d>> stretches;
  for (ProjectedStretch& stretch : Project(curve, none_shown, view, camera)) {
    stretches.push_back(std::move(stretch.pixels));
  }
  return stretches;
}

std::vector<ProjectedStretch> ProjectShownAndHidden(const Curve& curve,
                                                    const Scene& scene,
                                                    int view_idx) {
  const View& view = scene.views.at(static_cast<std::size_t>(view_idx));
  return Project(curve, AreShown(curve, view_idx), view, CameraOf(scene, view));
}

}  // namespace curvix
