// SPDX-License-Identifier: BSD-3-Clause
#include "model/posed_view.h"

#include <algorithm>

namespace curvix {
namespace {

// How far the ideal pinhole image of `camera` reaches beyond its frame, found
// along the border of the image; at most the longer side.
double MarginPx(const Camera& camera) {
  if (IsPinhole(camera)) return 0;
  const Eigen::Matrix3d calibration = PinholeCalibration(camera);
  const Eigen::Vector2d size(camera.width, camera.height);
  constexpr int kNumSteps = 16;
  double margin = 0;
  for (int side = 0; side < 4; ++side) {
    for (int step = 0; step <= kNumSteps; ++step) {
      const double across = side < 2 ? 0 : 1;
      const double along = static_cast<double>(step) / kNumSteps;
      const Eigen::Vector2d fraction = side % 2 == 0
                                           ? Eigen::Vector2d(across, along)
                                           : Eigen::Vector2d(along, across);
      const auto ideal = IdealFromImage(camera, fraction.cwiseProduct(size));
      if (!ideal) return size.maxCoeff();
      const Eigen::Vector2d pixel =
          (calibration * ideal->homogeneous()).hnormalized();
      margin = std::max({margin, -pixel.minCoeff(), (pixel - size).maxCoeff()});
    }
  }
  return std::min(margin, size.maxCoeff());
}

}  // namespace

void SetPose(const Rigid3& cam_from_world, PosedView* view) {
  view->rotation = cam_from_world.rotation.toRotationMatrix();
  view->translation = cam_from_world.translation;
  view->center = -(view->rotation.transpose() * view->translation);
}

PosedView MakePosedView(const Camera& camera, const Rigid3& cam_from_world) {
  PosedView view;
  view.calibration = PinholeCalibration(camera);
  SetPose(cam_from_world, &view);
  view.width = camera.width;
  view.height = camera.height;
  view.margin_px = MarginPx(camera);
  return view;
}

std::vector<PosedView> MakePosedViews(const Scene& scene) {
  std::vector<PosedView> posed;
  posed.reserve(scene.views.size());
  for (const View& view : scene.views) {
    posed.push_back(MakePosedView(CameraOf(scene, view), view.cam_from_world));
  }
  return posed;
}

}  // namespace curvix
