// SPDX-License-Identifier: BSD-3-Clause
// Posed views for tests.
#pragma once

#include <curvix/scene.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// 800 x 800 pixels, focal length 800, principal point in the middle.
inline PosedView MakeView(const Eigen::Matrix3d& cam_from_world,
                          const Eigen::Vector3d& center) {
  PosedView view;
  view.width = view.height = 800;
  view.calibration << 800, 0, 400, 0, 800, 400, 0, 0, 1;
  view.rotation = cam_from_world;
  view.translation = -view.rotation * center;
  view.center = center;
  return view;
}

// The same camera at `center`, looking at `target`; the world's z axis points
// upwards in the image. Not for looking along z.
inline PosedView LookAt(const Eigen::Vector3d& center,
                        const Eigen::Vector3d& target) {
  const Eigen::Vector3d z = (target - center).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rotation;
  rotation.row(0) = x;
  rotation.row(1) = z.cross(x);
  rotation.row(2) = z;
  return MakeView(rotation, center);
}

inline Eigen::Vector2d PixelOf(const PosedView& view,
                               const Eigen::Vector3d& x) {
  return view.Pixel(view.InCamera(x));
}

// The views as COLMAP would describe them, each with its own camera. Names
// count from view_000.
inline Scene ToScene(const std::vector<PosedView>& views) {
  Scene scene;
  for (const PosedView& posed : views) {
    const auto& k = posed.calibration;
    scene.cameras.push_back({CameraModel::kPinhole,
                             posed.width,
                             posed.height,
                             {k(0, 0), k(1, 1), k(0, 2), k(1, 2)}});
    const int idx = static_cast<int>(scene.views.size());
    View& view = scene.views.emplace_back();
    const std::string number = std::to_string(idx);
    view.name = "view_" + std::string(3 - number.size(), '0') + number;
    view.image_id = static_cast<std::uint32_t>(idx) + 1;
    view.camera_idx = idx;
    view.cam_from_world.rotation = Eigen::Quaterniond(posed.rotation);
    view.cam_from_world.rotation.normalize();
    view.cam_from_world.translation = posed.translation;
  }
  return scene;
}

}  // namespace curvix
