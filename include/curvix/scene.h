// SPDX-License-Identifier: BSD-3-Clause
// Posed views: what a COLMAP model says about cameras and images.
//
// Conventions, everywhere in this library:
//  * pixels: x right, y down, the centre of the top-left pixel is (0.5, 0.5);
//  * cameras: x right, y down, z forward; x_cam = cam_from_world * x_world;
//  * world: the unit and frame of the input model, never changed;
//  * *_idx counts from 0 without gaps, *_id is COLMAP's and may have gaps.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace curvix {

// A rigid motion, b_from_a: x_b = rotation * x_a + translation.
struct Rigid3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& x) const {
    return rotation * x + translation;
  }
  Rigid3 Inverse() const {
    const Eigen::Quaterniond back = rotation.conjugate();
    return {back, back * -translation};
  }
};

// c_from_a = c_from_b * b_from_a.
inline Rigid3 operator*(const Rigid3& c_from_b, const Rigid3& b_from_a) {
  return {(c_from_b.rotation * b_from_a.rotation).normalized(),
          c_from_b * b_from_a.translation};
}

// COLMAP's camera models; the values are COLMAP's model ids.
enum class CameraModel : int {
  kSimplePinhole = 0,
  kPinhole = 1,
  kSimpleRadial = 2,
  kRadial = 3,
  kOpenCV = 4,
  kOpenCVFisheye = 5,
  kFullOpenCV = 6,
  kFov = 7,
  kSimpleRadialFisheye = 8,
  kRadialFisheye = 9,
  kThinPrismFisheye = 10,
  kRadTanThinPrismFisheye = 11,
  kSimpleDivision = 12,
  kDivision = 13,
  kSimpleFisheye = 14,
  kFisheye = 15,
  kEucm = 16,
};

struct Camera {
  CameraModel model = CameraModel::kPinhole;
  int width = 0;               // pixels
  int height = 0;              // pixels
  std::vector<double> params;  // in COLMAP's order for the model

  friend bool operator==(const Camera& a, const Camera& b) {
    return a.model == b.model && a.width == b.width && a.height == b.height &&
           a.params == b.params;
  }
};

// One registered image.
struct View {
  std::string name;  // as in the model: relative to the image folder
  std::filesystem::path image_path;
  std::uint32_t image_id = 0;
  int camera_idx = 0;
  Rigid3 cam_from_world;
  // An image of the same size: edges are ignored where it is black. Empty: none
  // are.
  std::filesystem::path mask_path;
};

// One triangulated point of the sparse model and the views that see it.
struct ScenePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<int> view_idxs;  // ascending, without repeats
  // Where these views see it, in pixels of their images; not finite where that
  // is not known. One per view, or empty.
  std::vector<Eigen::Vector2d> pixels;
};

// Views are sorted by name. `points` may be empty: known poses are enough.
struct Scene {
  std::vector<Camera> cameras;
  std::vector<View> views;
  std::vector<ScenePoint> points;
};

}  // namespace curvix
