// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/seen_from.h"

#include <curvix/curves.h>
#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr double kSideDeg = 45;
constexpr int kLeastViews = 3;
constexpr double kLeastShare = 0.1;
constexpr std::size_t kMostSamples = 16;

}  // namespace

SeenFrom SeenFromSide(const CurveFit& fit,
                      const std::vector<SeenSample>& samples,
                      const Eigen::Vector3d& toward,
                      const Scene& scene) {
  const std::size_t count = std::min(fit.num_samples, kMostSamples);
  int num_views = 0, num_showing = 0;
  for (std::size_t i = 0; i < count; ++i) {
    // The middles of equal stretches.
    const std::size_t at = fit.num_samples * (2 * i + 1) / (2 * count);
    const SeenSample& sample =
        samples[(fit.first_sample + at) % samples.size()];
    for (const View& view : scene.views) {
      const Eigen::Vector3d ray =
          view.cam_from_world.Inverse().translation - sample.position;
      const Camera& camera = CameraOf(scene, view);
      if (ray.dot(toward) < std::cos(DegToRad(kSideDeg)) * ray.norm() ||
          !ProjectPoint(sample.position, view, camera)) {
        continue;
      }
      ++num_views;
      num_showing +=
          std::ranges::binary_search(sample.image_ids, view.image_id) ? 1 : 0;
    }
  }
  if (num_views < kLeastViews * static_cast<int>(count)) {
    return SeenFrom::kUnknown;
  }
  return num_showing < kLeastShare * num_views ? SeenFrom::kHidden
                                               : SeenFrom::kSeen;
}

FittedCurves WithoutHidden(const CurvesFile& curves,
                           const Eigen::Vector3d& toward,
                           const Scene& scene) {
  FittedCurves shown = curves.fitted;
  for (std::size_t c = 0; c < shown.curves.size(); ++c) {
    std::erase_if(shown.curves[c].fits, [&](const CurveFit& fit) {
      return SeenFromSide(fit, curves.samples[c], toward, scene) ==
             SeenFrom::kHidden;
    });
  }
  return shown;
}

}  // namespace curvix
