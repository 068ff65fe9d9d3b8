// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "geometry/posed_views.h"

#include <curvix/camera_model.h>

namespace curvix {

std::vector<PosedView> MakePosedViews(const Scene& scene) {
  std::vector<PosedView> posed;
  posed.reserve(scene.views.size());
  for (const View& view : scene.views) {
    const Camera& camera =
        scene.cameras[static_cast<std::size_t>(view.camera_idx)];
    PosedView& out = posed.emplace_back();
    out.calibration = PinholeCalibration(camera);
    out.rotation = view.cam_from_world.rotation.toRotationMatrix();
    out.translation = view.cam_from_world.translation;
    out.center = -(out.rotation.transpose() * out.translation);
    out.width = camera.width;
    out.height = camera.height;
  }
  return posed;
}

}  // namespace curvix
