// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/synthetic_truth.h"

#include "base/parallel.h"
#include "synthetic/counter_random.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace curvix {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSideDistancePx = 1.5;
constexpr double kMinContrast = 8;  // grey levels

bool IsHidden(const Solid& solid, const Vector3d& eye, const Vector3d& x) {
  const auto hit = solid.Trace({eye, x - eye});
  const double tolerance = 1e-6 * solid.radius() / (x - eye).norm();
  return hit && hit->t < 1 - tolerance;
}

// Where a point is seen; nullopt: it is hidden or not in the image.
std::optional<Vector2d> Sight(const Vector3d& x,
                              const Solid& solid,
                              const Camera& camera,
                              const Rigid3& cam_from_world) {
  const auto pixel = Project(camera, cam_from_world, x);
  const Vector2d size(camera.width, camera.height);
  if (!pixel || (pixel->array() < 0).any() ||
      (pixel->array() >= size.array()).any() ||
      IsHidden(solid, cam_from_world.Inverse().translation, x)) {
    return std::nullopt;
  }
  return pixel;
}

SampleInView LookAtSample(const TrueSample& sample,
                          const Solid& solid,
                          const Camera& camera,
                          const Rigid3& cam_from_world,
                          const GrayImage& image) {
  const auto pixel = Sight(sample.position, solid, camera, cam_from_world);
  if (!pixel) return {};
  const Vector3d in_cam = cam_from_world * sample.position;
  const Vector2d uv = in_cam.hnormalized();
  const Vector3d along = cam_from_world.rotation * sample.tangent;
  const Vector2d tangent = ImageFromIdealJacobian(camera, uv) *
                           (along.head<2>() - along.z() * uv) / in_cam.z();
  if (tangent.norm() == 0) return {true, false};  // seen end on
  const Vector2d across =
      kSideDistancePx * Vector2d(-tangent.y(), tangent.x()).normalized();
  const double contrast =
      Bilinear(image, *pixel + across) - Bilinear(image, *pixel - across);
  return {true, std::abs(contrast) >= kMinContrast};
}

// Where the ray through a pixel meets the surface.
std::optional<Vector3d> SurfaceAt(const Vector2d& pixel,
                                  const Solid& solid,
                                  const Camera& camera,
                                  const Rigid3& cam_from_world) {
  const std::optional<Vector2d> uv = IdealFromImage(camera, pixel);
  if (!uv) return std::nullopt;
  const Rigid3 world_from_cam = cam_from_world.Inverse();
  const Ray ray{world_from_cam.translation,
                world_from_cam.rotation * uv->homogeneous()};
  const std::optional<Hit> hit = solid.Trace(ray);
  if (!hit) return std::nullopt;
  return ray.origin + hit->t * ray.direction;
}

}  // namespace

std::vector<TrueSample> SampleCurves(const std::vector<TrueCurve>& curves,
                                     double step) {
  std::vector<TrueSample> samples;
  for (std::size_t id = 0; id < curves.size(); ++id) {
    const TrueCurve& curve = curves[id];
    const int num_steps =
        std::max(2, static_cast<int>(std::lround(curve.length / step)));
    const int num_samples = curve.is_closed ? num_steps : num_steps + 1;
    for (int i = 0; i < num_samples; ++i) {
      const double s = curve.length * i / num_steps;
      samples.push_back({curve.Position(s),
                         curve.Tangent(s),
                         static_cast<int>(id),
                         0,
                         0,
                         curve.kind});
    }
  }
  return samples;
}

std::vector<SampleInView> LookAtSamples(const std::vector<TrueSample>& samples,
                                        const Solid& solid,
                                        const Camera& camera,
                                        const Rigid3& cam_from_world,
                                        const GrayImage& image) {
  std::vector<SampleInView> looks;
  looks.reserve(samples.size());
  for (const TrueSample& sample : samples) {
    looks.push_back(LookAtSample(sample, solid, camera, cam_from_world, image));
  }
  return looks;
}

std::vector<ScenePoint> FindPoints(
    const Solid& solid,
    const Camera& camera,
    const std::vector<Rigid3>& poses,
    int num_per_view,
    std::uint64_t seed,
    int num_threads,
    const std::function<bool(std::size_t)>& keep_going) {
  const auto num_points = static_cast<std::size_t>(num_per_view);
  std::vector<ScenePoint> points(poses.size() * num_points);
  const auto find_point = [&](std::size_t i) {
    const Vector2d pixel(camera.width * Uniform(Mix(seed, 2 * i)),
                         camera.height * Uniform(Mix(seed, 2 * i + 1)));
    const auto position =
        SurfaceAt(pixel, solid, camera, poses[i / num_points]);
    if (!position) return true;
    points[i].position = *position;
    for (std::size_t view = 0; view < poses.size(); ++view) {
      if (const auto at = Sight(*position, solid, camera, poses[view])) {
        points[i].view_idxs.push_back(static_cast<int>(view));
        points[i].pixels.push_back(*at);
      }
    }
    return true;
  };
  ParallelForWhile(points.size(), num_threads, find_point, keep_going);
  std::erase_if(points,
                [](const ScenePoint& p) { return p.view_idxs.size() < 2; });
  return points;
}

}  // namespace curvix
