// SPDX-License-Identifier: BSD-3-Clause
// Posed views: what a COLMAP model says about cameras and images.
//
// Conventions, everywhere in this library:
//  * pixels: x right, y down, the centre of the top-left pixel is (0.5, 0.5);
//  * cameras: x right, y down, z forward; x_cam = cam_from_world * x_world;
//  * world: the unit and frame of the input model, never changed;
//  * *_idx counts from 0 without gaps, *_id is COLMAP's and may have gaps.
#pragma once

#include <curvix/status.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
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

// An image in memory: width * height * num_channels values, row by row from the
// top left, the channels of a pixel side by side. It is only read. Copies share
// the values; a pointer that owns nothing lends them.
struct ImageInMemory {
  int width = 0;         // pixels
  int height = 0;        // pixels
  int num_channels = 1;  // 1: grey; 3: red, green, blue; 4: these and alpha
  std::variant<std::shared_ptr<const std::uint8_t[]>,
               std::shared_ptr<const std::uint16_t[]>>
      values;  // 0 to 255, or 0 to 65535
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
  // Taken in place of the file, which need not exist then.
  std::optional<ImageInMemory> image;
};

// One triangulated point of the sparse model and the views that see it.
struct ScenePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<int> view_idxs;  // ascending, without repeats
  // Where these views see it, in pixels of their images; not finite where that
  // is not known. One per view, or empty.
  std::vector<Eigen::Vector2d> pixels;
  std::uint64_t point3D_id = 0;  // in the model
};

// Views are sorted by name. `points` may be empty: known poses are enough.
struct Scene {
  std::vector<Camera> cameras;
  std::vector<View> views;
  std::vector<ScenePoint> points;
};

// The camera of one of the scene's views.
inline const Camera& CameraOf(const Scene& scene, const View& view) {
  return scene.cameras.at(static_cast<std::size_t>(view.camera_idx));
}

// COLMAP's camera models, both ways: ids 0 to 16, with COLMAP's formulas.
// EQUIRECTANGULAR (17) has no pinhole image and is not supported.  u = X/Z and
// v = Y/Z are ideal image coordinates. The ideal pinhole of a camera has its
// focal lengths and principal point and no distortion: it is the image plane in
// which all later stages work.

// The number of parameters of `model`. Here and in ModelName, `model` is one of
// the enumerators.
int NumParams(CameraModel model);

// COLMAP's name of `model`, "SIMPLE_RADIAL" say, and back. nullopt: unknown.
std::string_view ModelName(CameraModel model);
std::optional<CameraModel> ModelFromName(std::string_view name);
std::optional<CameraModel> ModelFromId(int colmap_model_id);

// kInvalidArgument unless size, parameter count and values make a camera:
// positive size, finite parameters, positive focal lengths; FOV: |omega| < pi;
// EUCM: 0 <= alpha <= 1 and beta > 0. The functions below need a valid camera.
Status Validate(const Camera& camera);

// The ideal pinhole's calibration matrix.
Eigen::Matrix3d PinholeCalibration(const Camera& camera);

// Whether the model is its own ideal pinhole (PINHOLE, SIMPLE_PINHOLE).
bool IsPinhole(const Camera& camera);

// The pixel at which the direction (u, v, 1) is seen. NaN where the camera has
// no image of it (the division models with k > 0, beyond 4 k (u^2 + v^2) = 1).
// Far outside the image, polynomial models fold over and the pixel means
// nothing; IdealFromImage(ImageFromIdeal(uv)) != uv tells.
Eigen::Vector2d ImageFromIdeal(const Camera& camera, const Eigen::Vector2d& uv);

// The direction (u, v, 1) seen at `pixel`: Newton's method on the distortion,
// started at the undistorted guess and kept where the model is one-to-one (its
// Jacobian's determinant positive). nullopt where it does not converge to
// within 1e-6 px, or where the direction is more than 80 degrees off the
// optical axis.
std::optional<Eigen::Vector2d> IdealFromImage(const Camera& camera,
                                              const Eigen::Vector2d& pixel);

// d ImageFromIdeal / d(u, v), exact; [pixels per unit of (u, v)].
Eigen::Matrix2d ImageFromIdealJacobian(const Camera& camera,
                                       const Eigen::Vector2d& uv);

// Where a camera at `cam_from_world` sees `position`; nullopt behind the camera
// and where it has no image of it.
std::optional<Eigen::Vector2d> Project(const Camera& camera,
                                       const Rigid3& cam_from_world,
                                       const Eigen::Vector3d& position);

}  // namespace curvix
