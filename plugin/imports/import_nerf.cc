// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/scene.h>
#include <curvix/status.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/count_text.h"
#include "base/file_io.h"
#include "colmap/files.h"
#include "edge_detection/load_image.h"
#include "plugin/base/json.h"
#include "plugin/imports/importers.h"
#include "plugin/imports/projection_matrix.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

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
  Status CheckNumbers() const {
    for (const char* key : {"w",
                            "h",
                            "fl_x",
                            "fl_y",
                            "cx",
                            "cy",
                            "camera_angle_x",
                            "camera_angle_y",
                            "k1",
                            "k2",
                            "k3",
                            "k4",
                            "p1",
                            "p2"}) {
      const Json* const value = Find(key);
      if (value == nullptr || value->is_number()) continue;
      return Status::DataLoss(std::string(key) + " is not a number");
    }
    return {};
  }

 private:
  const Json& frame_;
  const Json& file_;
};

// The leading rows x cols numbers of a list of lists, which may be longer.
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

// The PINHOLE camera; distortion comes later.
Result<Camera> Pinhole(const Fields& fields,
                       const ImageSize& image,
                       std::optional<double> first_pixel) {
  if (const Json* const rows = fields.Find("camera_intrinsics")) {
    const auto matrix = ReadMatrix(rows, 3, 3);
    if (!matrix) {
      return Status::DataLoss("camera_intrinsics is not a 3 x 3 matrix");
    }
    return CameraFromCalibration(
        *matrix, image.width, image.height, first_pixel.value_or(0));
  }
  const auto focal = [&](const char* length, const char* angle, int size) {
    const std::optional<double> radians = fields.Number(angle);
    if (fields.Number(length) || !radians) return fields.Number(length);
    return std::optional(0.5 * size / std::tan(0.5 * *radians));
  };
  const auto fx = focal("fl_x", "camera_angle_x", image.width);
  if (!fx) {
    return Status::DataLoss(
        "there is no camera_intrinsics, fl_x or camera_angle_x");
  }
  // Pixels are square unless fl_y, or an angle beside an angle, says otherwise.
  const auto fy = fields.Number("fl_x")
                      ? fields.Number("fl_y")
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

// Whether the camera is a fisheye; kUnsupported for models that are not ours.
Result<bool> IsFisheye(const Fields& fields) {
  const Json* const flag = fields.Find("is_fisheye");
  if (flag && flag->is_boolean() && flag->get<bool>()) return true;
  const Json* const model = fields.Find("camera_model");
  if (model == nullptr) return false;
  const std::string name = model->is_string() ? model->get<std::string>() : "";
  if (name == "OPENCV_FISHEYE") return true;
  for (const char* known : {"PINHOLE",
                            "SIMPLE_PINHOLE",
                            "OPENCV",
                            "SIMPLE_RADIAL",
                            "RADIAL",
                            "FULL_OPENCV"}) {
    if (name == known) return false;
  }
  return Status::Unsupported(
      "camera_model is " + model->dump() +
      ", which cannot be imported; undistort the images");
}

Status AddDistortion(const Fields& fields, Camera* camera) {
  const auto value = [&](const char* key) {
    return fields.Number(key).value_or(0);
  };
  const double k1 = value("k1"), k2 = value("k2"), k3 = value("k3");
  const double k4 = value("k4"), p1 = value("p1"), p2 = value("p2");
  const Result<bool> fisheye = IsFisheye(fields);
  if (!fisheye.ok()) return fisheye.status();
  std::vector<double> more;
  if (*fisheye) {
    camera->model = CameraModel::kOpenCVFisheye;
    more = {k1, k2, k3, k4};
  } else if (k4 != 0) {
    return Status::Unsupported(
        "k4 is not zero, which only fisheye cameras may have; undistort the "
        "images");
  } else if (k3 != 0) {
    camera->model = CameraModel::kFullOpenCV;
    more = {k1, k2, p1, p2, k3, 0, 0, 0};
  } else if (k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0) {
    camera->model = CameraModel::kOpenCV;
    more = {k1, k2, p1, p2};
  }
  camera->params.insert(camera->params.end(), more.begin(), more.end());
  return {};
}

// The camera of a frame of a transforms.json, both of which are JSON objects,
// as ImportNerf explains. `first_pixel` wins over the convention of the source.
// Errors are parts of a sentence: "camera_model is EQUIRECTANGULAR, ...".
Result<Camera> NerfCamera(const Json& frame,
                          const Json& file,
                          const ImageSize& image,
                          std::optional<double> first_pixel) {
  const Fields fields(frame, file);
  if (Status status = fields.CheckNumbers(); !status.ok()) return status;
  const double width = fields.Number("w").value_or(image.width);
  const double height = fields.Number("h").value_or(image.height);
  if (width != image.width || height != image.height) {
    return Status::DataLoss("w and h are not the size of the image, " +
                            SizeText(image) +
                            "; take the images that the cameras were made for");
  }
  Result<Camera> camera = Pinhole(fields, image, first_pixel);
  if (!camera.ok()) return camera;
  camera->width = image.width;
  camera->height = image.height;
  if (Status s = AddDistortion(fields, &*camera); !s.ok()) return s;
  const Status status = Validate(*camera);
  if (!status.ok()) return Status::DataLoss(status.message());
  return camera;
}

// "transform_matrix" of `frame` as cam_from_world with COLMAP's axes. kDataLoss
// if there is none, or if it is not a similarity transform.
Result<Rigid3> NerfPose(const Json& frame) {
  const auto found = frame.find("transform_matrix");
  const Json* const rows = found == frame.end() ? nullptr : &*found;
  const auto matrix = ReadMatrix(rows, 3, 4);
  if (!matrix) {
    return Status::DataLoss("transform_matrix is not a 4 x 4 matrix");
  }
  const auto bottom = rows->size() > 3 ? ReadMatrix(rows, 4, 4) : std::nullopt;
  if (rows->size() > 3 &&
      (!bottom || bottom->row(3) != Eigen::RowVector4d(0, 0, 0, 1))) {
    return Status::DataLoss("transform_matrix does not end in the row 0 0 0 1");
  }
  Eigen::Matrix3d axes = matrix->leftCols<3>();
  axes.rightCols<2>() *= -1;  // OpenGL's y and z
  const auto rotation = RotationFromMatrix(axes);
  if (!rotation) return Status::DataLoss("transform_matrix holds no rotation");
  return Rigid3{*rotation, matrix->col(3)}.Inverse();
}

Result<Json> ReadTransforms(const fs::path& file) {
  const Result<std::string> text = ReadFile(file);
  if (!text.ok()) return text.status();
  Json document = Json::parse(*text, nullptr, false);
  if (!document.is_object()) {
    return Status::DataLoss(file.string() +
                            " is not JSON that can be read (NaN and Infinity "
                            "are not JSON); export it again.");
  }
  const auto frames = document.find("frames");
  const bool usable = frames != document.end() && frames->is_array() &&
                      std::ranges::all_of(*frames, [](const Json& frame) {
                        return frame.is_object() &&
                               frame.contains("file_path") &&
                               frame["file_path"].is_string();
                      });
  if (usable) return document;
  return Status::DataLoss(
      file.string() +
      " has no list of frames that each have a file_path; export it again.");
}

// The frame's file_path with '/' between folders, without "./".
std::string FilePathOf(const Json& frame) {
  std::string text = frame["file_path"].get<std::string>();
  std::ranges::replace(text, '\\', '/');
  return fs::path(text).lexically_normal().generic_string();
}

// The name below `root`, with extension, of the image `name`, which may
// lack its extension; empty: it is not there.
std::string FindName(const fs::path& root, const std::string& name) {
  for (const char* extension : {"",
                                ".png",
                                ".jpg",
                                ".jpeg",
                                ".PNG",
                                ".JPG",
                                ".JPEG",
                                ".tif",
                                ".tiff",
                                ".webp"}) {
    if (IsFile(root / (name + extension))) return name + extension;
  }
  return "";
}

// The names of the frames' images below `root`. By the last parts of
// their paths, if `by_last_part` and the whole is not there.
Result<std::vector<std::string>> FindNames(const Json& frames,
                                           const fs::path& root,
                                           bool by_last_part,
                                           const fs::path& source) {
  std::vector<std::string> names;
  std::vector<std::string> missing;
  for (const Json& frame : frames) {
    const std::string path = FilePathOf(frame);
    const std::string last = fs::path(path).filename().string();
    Status status = CheckImageName(path, source);
    std::string name = status.ok() ? FindName(root, path) : "";
    if (by_last_part && name.empty() && CheckImageName(last, source).ok()) {
      name = FindName(root, last);
    } else if (!status.ok()) {
      return status;
    }
    if (name.empty()) missing.push_back(path);
    names.push_back(std::move(name));
  }
  if (missing.empty()) return names;
  return Status::NotFound(
      std::to_string(missing.size()) + " of " + Plural(names.size(), "image") +
      OneOrMore(missing.size(), " is", " are") + " not in " + root.string() +
      " (" + FirstNames(missing) + "); name their folder with --image_path.");
}

Result<ImportedView> ViewOf(const Json& frame,
                            const Json& document,
                            const fs::path& file,
                            std::optional<double> first_pixel) {
  const Result<ImageSize> size = ReadImageSize(file);
  if (!size.ok()) return size.status();
  const Result<Camera> camera = NerfCamera(frame, document, *size, first_pixel);
  if (!camera.ok()) return camera.status();
  const Result<Rigid3> pose = NerfPose(frame);
  if (!pose.ok()) return pose.status();
  return ImportedView{"", file, *camera, *pose};
}

fs::path TransformsFile(const fs::path& input_path) {
  if (!IsFolder(input_path)) return input_path;
  const fs::path train = input_path / "transforms_train.json";
  const fs::path all = input_path / "transforms.json";
  return !IsFile(all) && IsFile(train) ? train : all;
}

}  // namespace

Result<ImportedScene> ImportNerf(const ImportOptions& options) {
  const fs::path file = TransformsFile(options.input_path);
  const Result<Json> document = ReadTransforms(file);
  if (!document.ok()) return document.status();
  const Json& frames = (*document)["frames"];
  const Result<fs::path> root =
      FindImageFolder(options.image_path, {file.parent_path()}, "");
  if (!root.ok()) return root.status();
  const Result<std::vector<std::string>> names =
      FindNames(frames, *root, !options.image_path.empty(), file);
  if (!names.ok()) return names.status();
  std::vector<ImportedView> views;
  for (std::size_t i = 0; i < names->size(); ++i) {
    const std::string& name = (*names)[i];
    Result<ImportedView> view =
        ViewOf(frames[i], *document, *root / name, options.first_pixel);
    if (!view.ok()) {
      return Status(view.status().code(),
                    file.string() + ", frame " + std::to_string(i + 1) + " (" +
                        name + "): " + view.status().message());
    }
    view->name = name;
    views.push_back(std::move(view).value());
  }
  return SceneOfViews(views, file);
}

}  // namespace curvix
