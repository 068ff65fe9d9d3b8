// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "synthetic/synthetic_truth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

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

SampleInView LookAtSample(const TrueSample& sample,
                          const Solid& solid,
                          const Camera& camera,
                          const Rigid3& cam_from_world,
                          const RenderedImage& image) {
  const Vector3d in_cam = cam_from_world * sample.position;
  if (in_cam.z() <= 0) return {};
  const Vector2d uv = in_cam.hnormalized();
  const Vector2d pixel = ImageFromIdeal(camera, uv);
  const Vector2d size(camera.width, camera.height);
  if ((pixel.array() < 0).any() || (pixel.array() >= size.array()).any() ||
      IsHidden(solid, cam_from_world.Inverse().translation, sample.position)) {
    return {};
  }
  const Vector3d along = cam_from_world.rotation * sample.tangent;
  const Vector2d tangent = ImageFromIdealJacobian(camera, uv) *
                           (along.head<2>() - along.z() * uv) / in_cam.z();
  if (tangent.norm() == 0) return {true, false};  // seen end on
  const Vector2d across =
      kSideDistancePx * Vector2d(-tangent.y(), tangent.x()).normalized();
  const double contrast = image.At(pixel + across) - image.At(pixel - across);
  return {true, std::abs(contrast) >= kMinContrast};
}

}  // namespace

std::vector<TrueSample> SampleCurves(const std::vector<CreaseCurve>& curves,
                                     double step) {
  std::vector<TrueSample> samples;
  for (std::size_t id = 0; id < curves.size(); ++id) {
    const CreaseCurve& curve = curves[id];
    const int num_steps =
        std::max(2, static_cast<int>(std::lround(curve.length / step)));
    const int num_samples = curve.is_closed ? num_steps : num_steps + 1;
    for (int i = 0; i < num_samples; ++i) {
      const double s = curve.length * i / num_steps;
      samples.push_back(
          {curve.Position(s), curve.Tangent(s), static_cast<int>(id), 0, 0});
    }
  }
  return samples;
}

std::vector<SampleInView> LookAtSamples(const std::vector<TrueSample>& samples,
                                        const Solid& solid,
                                        const Camera& camera,
                                        const Rigid3& cam_from_world,
                                        const RenderedImage& image) {
  std::vector<SampleInView> looks;
  looks.reserve(samples.size());
  for (const TrueSample& sample : samples) {
    looks.push_back(LookAtSample(sample, solid, camera, cam_from_world, image));
  }
  return looks;
}

}  // namespace curvix
