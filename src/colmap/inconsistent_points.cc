// SPDX-License-Identifier: BSD-3-Clause
#include "colmap/inconsistent_points.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "base/infinity.h"
#include "base/median.h"
#include "base/text_fields.h"

namespace curvix {
namespace {

constexpr double kMaxMedianPx = 50;
// Edges of views that are further off are hardly matched.
constexpr double kMaxUsualMedianPx = 2;
constexpr std::size_t kMinPixels = 100;

std::vector<double> AllErrors(const Scene& scene) {
  std::vector<double> errors;
  for (const ScenePoint& point : scene.points) {
    const std::vector<double> more = ReprojectionErrors(scene, point);
    errors.insert(errors.end(), more.begin(), more.end());
  }
  return errors;
}

}  // namespace

std::vector<double> ReprojectionErrors(const Scene& scene,
                                       const ScenePoint& point) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < point.pixels.size(); ++i) {
    if (!point.pixels[i].allFinite()) continue;
    const View& view =
        scene.views[static_cast<std::size_t>(point.view_idxs[i])];
    const auto pixel =
        Project(CameraOf(scene, view), view.cam_from_world, point.position);
    errors.push_back(pixel ? (*pixel - point.pixels[i]).norm() : kInfinity);
  }
  return errors;
}

std::string RemoveInconsistentPoints(const std::filesystem::path& model_path,
                                     Scene* scene) {
  const double median_px = MedianOr(0, AllErrors(*scene));
  if (median_px <= kMaxMedianPx) return "";
  scene->points.clear();
  const bool is_in_front = std::isfinite(median_px);
  const std::string place = is_in_front ? "project " + FixedText(median_px, 0) +
                                              " px from their pixels"
                                        : "are behind the cameras";
  const std::string cause =
      is_in_front
          ? "Were they moved or scaled without these, or is a focal length "
            "wrong?"
          : "Do the cameras look along -z, as in OpenGL and Blender? COLMAP's "
            "axes are x right, y down, z forwards.";
  return "The points of " + model_path.string() + " " + place +
         " (median), so they do not belong to its poses; their positions are "
         "not used. " +
         cause;
}

std::string LargeErrorsNote(const Scene& scene) {
  std::vector<double> errors = AllErrors(scene);
  if (errors.size() < kMinPixels) return "";
  const double median_px = Median(std::move(errors));
  if (median_px <= kMaxUsualMedianPx) return "";
  return "WARNING: The points project " + FixedText(median_px, 1) +
         " px from their pixels (median), so poses or cameras are wrong, as "
         "with a wrong focal length, and curves will be missing or off; refine "
         "both with COLMAP's bundle_adjuster, and use the model that it "
         "writes.";
}

}  // namespace curvix
