// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/nerf_camera.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "base/angles.h"
#include "base/text_fields.h"
#include "plugin/imports/projection_matrix.h"

namespace curvix {

std::optional<Eigen::MatrixXd> ReadMatrix(const Json* rows,
                                          std::size_t num_rows,
                                          std::size_t num_cols) {
  if (!rows || !rows->is_array() || rows->size() < num_rows) return {};
  Eigen::MatrixXd matrix(num_rows, num_cols);
  for (std::size_t i = 0; i < num_rows; ++i) {
    const Json& row = (*rows)[i];
    if (!row.is_array() || row.size() < num_cols) return {};
    for (std::size_t j = 0; j < num_cols; ++j) {
      if (!row[j].is_number()) return {};
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          row[j].get<double>();
    }
  }
  return matrix;
}

namespace {

// What a frame says, else what the file says.
class Fields {
 public:
  Fields(const Json& frame, const Json& file) : frame_(frame), file_(file) {}

  // nullptr: neither says it.
  const Json* Find(const char* key) const {
    for (const Json* object : {&frame_, &file_}) {
      const auto found = object->find(key);
      if (found != object->end() && !found->is_null()) return &*found;
    }
    return nullptr;
  }
  // CheckNumbers() has seen that these are numbers.
  std::optional<double> Number(const char* key) const {
    const Json* const value = Find(key);
    return value ? std::optional(value->get<double>()) : std::nullopt;
  }
  // Those of the frame alone if it has any of `keys`, else of the file alone.
  Fields WithAnyOf(std::initializer_list<const char*> keys) const {
    static const Json kNothing = Json::object();
    for (const char* key : keys) {
      const auto found = frame_.find(key);
      if (found != frame_.end() && !found->is_null()) return {frame_, kNothing};
    }
    return {file_, kNothing};
  }
  Status CheckNumbers() const {
    for (const std::string_view word :
         SplitAt("w h fl_x fl_y cx cy camera_angle_x camera_angle_y "
                 "k1 k2 k3 k4 k5 k6 p1 p2",
                 ' ')) {
      const std::string key(word);
      const Json* const value = Find(key.c_str());
      if (value == nullptr || value->is_number()) continue;
      return Status::DataLoss(key + " is not a number");
    }
    return {};
  }

 private:
  const Json& frame_;
  const Json& file_;
};

// The PINHOLE camera; distortion comes later.
Result<Camera> Pinhole(const Fields& fields,
                       const ImageSize& image,
                       std::optional<double> first_pixel) {
  const Fields own =
      fields.WithAnyOf({"camera_intrinsics", "fl_x", "camera_angle_x"});
  if (const Json* const rows = own.Find("camera_intrinsics")) {
    const auto matrix = ReadMatrix(rows, 3, 3);
    if (!matrix) {
      return Status::DataLoss("camera_intrinsics is not a 3 x 3 matrix");
    }
    return CameraFromCalibration(
        *matrix, image.width, image.height, first_pixel.value_or(0));
  }
  const auto focal = [&](const char* length, const char* angle, int size) {
    const std::optional<double> radians = own.Number(angle);
    if (own.Number(length) || !radians) return own.Number(length);
    // No length for an angle that is none, as one in degrees.
    const bool is_angle = *radians > 0 && *radians < kPi;
    return std::optional(is_angle ? 0.5 * size / std::tan(0.5 * *radians) : 0);
  };
  const auto fx = focal("fl_x", "camera_angle_x", image.width);
  if (!fx) {
    return Status::DataLoss(
        "there is no camera_intrinsics, fl_x or camera_angle_x");
  }
  if (!own.Number("fl_x") && !(*fx > 0)) {
    return Status::DataLoss("camera_angle_x is no angle of view in radians");
  }
  // Pixels are square unless fl_y, or an angle beside an angle, says otherwise.
  const auto fy = own.Number("fl_x")
                      ? own.Number("fl_y")
                      : focal("fl_y", "camera_angle_y", image.height);
  const double shift = 0.5 - first_pixel.value_or(0.5);
  const auto center = [&](const char* key, int size) {
    const std::optional<double> value = fields.Number(key);
    return value ? *value + shift : 0.5 * size;
  };
  Camera camera;
  camera.params = {*fx,
                   fy.value_or(*fx),
                   center("cx", image.width),
                   center("cy", image.height)};
  return camera;
}

Status NotImported(const std::string& what) {
  return Status::Unsupported(
      what + ", which cannot be imported; undistort the images");
}

// The model of the camera if it has all distortion that it may have.
// kUnsupported for models that are not COLMAP's.
Result<CameraModel> LargestModel(const Fields& fields) {
  for (const char* key : {"latlong", "equirectangular", "ftheta_p0"}) {
    if (fields.Find(key)) return NotImported("there is " + std::string(key));
  }
  const Json* const flag = fields.Find("is_fisheye");
  if (flag && !flag->is_boolean()) {
    return Status::DataLoss("is_fisheye is not true or false");
  }
  if (flag && flag->get<bool>()) return CameraModel::kOpenCVFisheye;
  const Json* const model = fields.Find("camera_model");
  if (model == nullptr) return CameraModel::kOpenCV;
  if (!model->is_string()) {
    return Status::DataLoss("camera_model is not a text");
  }
  const std::string name = model->get<std::string>();
  if (name == "OPENCV_FISHEYE") return CameraModel::kOpenCVFisheye;
  if (name == "FULL_OPENCV") return CameraModel::kFullOpenCV;
  for (const char* known :
       {"PINHOLE", "SIMPLE_PINHOLE", "OPENCV", "SIMPLE_RADIAL", "RADIAL"}) {
    if (name == known) return CameraModel::kOpenCV;
  }
  return NotImported("camera_model is " + name);
}

struct Distortion {
  std::array<double, 6> k = {};
  double p1 = 0, p2 = 0;
};

// distortion_params (k1 to k4, p1, p2), or the numbers one by one.
Result<Distortion> ReadDistortion(const Fields& fields) {
  constexpr std::array kKeys = {"k1", "k2", "k3", "k4", "k5", "k6"};
  Distortion distortion;
  const Fields own = fields.WithAnyOf(
      {"distortion_params", "k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"});
  const Json* const list = own.Find("distortion_params");
  if (list == nullptr) {
    for (std::size_t i = 0; i < kKeys.size(); ++i) {
      distortion.k[i] = own.Number(kKeys[i]).value_or(0);
    }
    distortion.p1 = own.Number("p1").value_or(0);
    distortion.p2 = own.Number("p2").value_or(0);
    return distortion;
  }
  const Json rows = Json::array({*list});
  const auto row = ReadMatrix(&rows, 1, 6);
  if (!row || list->size() != 6) {
    return Status::DataLoss(
        "distortion_params is not a list of k1, k2, k3, k4, p1, p2");
  }
  for (std::size_t i = 0; i < 4; ++i) {
    distortion.k[i] = (*row)(0, static_cast<Eigen::Index>(i));
  }
  distortion.p1 = (*row)(0, 4);
  distortion.p2 = (*row)(0, 5);
  return distortion;
}

Status AddDistortion(const Fields& fields, Camera* camera) {
  CURVIX_ASSIGN_OR_RETURN(const CameraModel largest, LargestModel(fields));
  CURVIX_ASSIGN_OR_RETURN(const Distortion distortion, ReadDistortion(fields));
  const auto& [k, p1, p2] = distortion;
  const bool has_tangential = p1 != 0 || p2 != 0;
  const bool has_denominator = k[3] != 0 || k[4] != 0 || k[5] != 0;
  std::vector<double> more;
  if (largest == CameraModel::kOpenCVFisheye) {
    if (has_tangential) return NotImported("p1 and p2 of a fisheye are not 0");
    camera->model = CameraModel::kOpenCVFisheye;
    more = {k[0], k[1], k[2], k[3]};
  } else if (has_denominator && largest != CameraModel::kFullOpenCV) {
    return NotImported(
        "k4, k5 or k6 is not 0, and the camera neither a fisheye nor "
        "FULL_OPENCV");
  } else if (k[2] != 0 || has_denominator) {
    camera->model = CameraModel::kFullOpenCV;
    more = {k[0], k[1], p1, p2, k[2], k[3], k[4], k[5]};
  } else if (k[0] != 0 || k[1] != 0 || has_tangential) {
    camera->model = CameraModel::kOpenCV;
    more = {k[0], k[1], p1, p2};
  }
  camera->params.insert(camera->params.end(), more.begin(), more.end());
  return {};
}

}  // namespace

Result<Camera> NerfCamera(const Json& frame,
                          const Json& file,
                          const ImageSize& image,
                          std::optional<double> first_pixel) {
  const Fields fields(frame, file);
  CURVIX_RETURN_IF_ERROR(fields.CheckNumbers());
  const double width = fields.Number("w").value_or(image.width);
  const double height = fields.Number("h").value_or(image.height);
  if (width != image.width || height != image.height) {
    return Status::DataLoss("w and h are not the size of the image, " +
                            SizeText(image) +
                            "; take the images that the cameras were made for");
  }
  CURVIX_ASSIGN_OR_RETURN(Camera camera, Pinhole(fields, image, first_pixel));
  camera.width = image.width;
  camera.height = image.height;
  CURVIX_RETURN_IF_ERROR(AddDistortion(fields, &camera));
  const Status status = Validate(camera);
  if (!status.ok()) return Status::DataLoss(status.message());
  return camera;
}

}  // namespace curvix
