// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What the stages need to know of a view.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace curvix {

// A view as an ideal pinhole: pixel ~ calibration * (rotation * X +
// translation).
struct PosedView {
  Eigen::Matrix3d calibration = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // cam_from_world
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   // cam_from_world
  Eigen::Vector3d center = Eigen::Vector3d::Zero();        // camera, in world
  int width = 0;                                           // pixels
  int height = 0;                                          // pixels
  // How far the image, freed of its distortion, reaches beyond width and
  // height.
  double margin_px = 0;

  Eigen::Vector3d InCamera(const Eigen::Vector3d& x) const {
    return rotation * x + translation;
  }
  // Pixel of a point given in camera coordinates, z > 0.
  Eigen::Vector2d Pixel(const Eigen::Vector3d& x_cam) const {
    return {calibration(0, 0) * x_cam.x() / x_cam.z() + calibration(0, 2),
            calibration(1, 1) * x_cam.y() / x_cam.z() + calibration(1, 2)};
  }
  bool Contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= -margin_px && pixel.y() >= -margin_px &&
           pixel.x() < width + margin_px && pixel.y() < height + margin_px;
  }
  // World direction, not normalised, in which `pixel` is seen.
  Eigen::Vector3d Ray(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d in_camera(
        (pixel.x() - calibration(0, 2)) / calibration(0, 0),
        (pixel.y() - calibration(1, 2)) / calibration(1, 1),
        1.0);
    return rotation.transpose() * in_camera;
  }
};

// The ideal pinhole of a camera, which must be valid.
PosedView MakePosedView(const Camera& camera, const Rigid3& cam_from_world);

// Moves a view; its camera stays.
void SetPose(const Rigid3& cam_from_world, PosedView* view);

// One per view of the scene, in order. Cameras must be valid.
std::vector<PosedView> MakePosedViews(const Scene& scene);

}  // namespace curvix
