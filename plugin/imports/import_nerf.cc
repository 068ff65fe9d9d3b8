// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/scene.h>
#include <curvix/status.h>
#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/count_text.h"
#include "base/file_io.h"
#include "base/text_fields.h"
#include "colmap/files.h"
#include "edge_detection/load_image.h"
#include "plugin/base/json.h"
#include "plugin/imports/importers.h"
#include "plugin/imports/nerf_camera.h"
#include "plugin/imports/projection_matrix.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// "transform_matrix" of `frame` as cam_from_world with COLMAP's axes. kDataLoss
// if there is none, or if it is not a similarity transform.
Result<Rigid3> NerfPose(const Json& frame) {
  const auto found = frame.find("transform_matrix");
  const Json* const rows = found == frame.end() ? nullptr : &*found;
  const auto matrix = ReadMatrix(rows, 3, 4);
  if (!matrix) {
    return Status::DataLoss("transform_matrix is not a 4 x 4 matrix");
  }
  constexpr double kRounding = 1e-6;
  const auto bottom = rows->size() > 3 ? ReadMatrix(rows, 4, 4) : std::nullopt;
  if (rows->size() > 3 &&
      (!bottom || !((bottom->row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() <
                    kRounding))) {
    return Status::DataLoss("transform_matrix does not end in the row 0 0 0 1");
  }
  Eigen::Matrix3d axes = matrix->leftCols<3>();
  axes.rightCols<2>() *= -1;  // OpenGL's y and z
  const auto rotation = RotationFromMatrix(axes);
  if (!rotation) return Status::DataLoss("transform_matrix holds no rotation");
  return Rigid3{*rotation, matrix->col(3)}.Inverse();
}

Result<Json> ReadTransforms(const fs::path& file) {
  CURVIX_ASSIGN_OR_RETURN(const std::string text, ReadFile(file));
  constexpr bool kThrow = false, kIgnoreComments = true;
  Json document = Json::parse(text, nullptr, kThrow, kIgnoreComments);
  if (!document.is_object()) {
    return Status::DataLoss(file.string() +
                            " is not valid JSON (NaN and Infinity are not), "
                            "or is cut short; export it again.");
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
  if (IsFile(root / name)) return name;
  for (const std::string_view extension :
       SplitAt(".png .jpg .jpeg .PNG .JPG .JPEG .tif .tiff .webp", ' ')) {
    std::string whole = name + std::string(extension);
    if (IsFile(root / whole)) return whole;
  }
  return "";
}

// `path` without its first `num` folders.
std::string WithoutFolders(const fs::path& path, std::ptrdiff_t num) {
  fs::path rest;
  for (auto part = std::next(path.begin(), num); part != path.end(); ++part) {
    rest /= *part;
  }
  return rest.generic_string();
}

// The name below `root` of the image at `path`; if `by_last_parts`, without the
// fewest first folders without which it is there. Empty: it is not there.
std::string FindBelow(const fs::path& root,
                      const fs::path& path,
                      bool by_last_parts) {
  const auto num_parts = std::distance(path.begin(), path.end());
  for (std::ptrdiff_t num = 0; num < (by_last_parts ? num_parts : 1); ++num) {
    const std::string rest = WithoutFolders(path, num);
    if (!CheckImageName(rest, root).ok()) continue;
    std::string name = FindName(root, rest);
    if (!name.empty()) return name;
  }
  return "";
}

// The names of the frames' images below `root`.
Result<std::vector<std::string>> FindNames(const Json& frames,
                                           const fs::path& root,
                                           bool by_last_parts,
                                           const fs::path& source) {
  std::vector<std::string> names;
  std::vector<std::string> missing;
  for (const Json& frame : frames) {
    const fs::path path = FilePathOf(frame);
    CURVIX_RETURN_IF_ERROR(CheckImageName(path.filename().string(), source));
    names.push_back(FindBelow(root, path, by_last_parts));
    if (names.back().empty()) missing.push_back(path.string());
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
  CURVIX_ASSIGN_OR_RETURN(const ImageSize size, ReadImageSize(file));
  CURVIX_ASSIGN_OR_RETURN(const Camera camera,
                          NerfCamera(frame, document, size, first_pixel));
  CURVIX_ASSIGN_OR_RETURN(const Rigid3 pose, NerfPose(frame));
  return ImportedView{"", file, camera, pose};
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
  CURVIX_ASSIGN_OR_RETURN(const Json document, ReadTransforms(file));
  const Json& frames = document["frames"];
  CURVIX_ASSIGN_OR_RETURN(
      const fs::path root,
      FindImageFolder(options.image_path, {file.parent_path()}, ""));
  CURVIX_ASSIGN_OR_RETURN(
      const std::vector<std::string> names,
      FindNames(frames, root, !options.image_path.empty(), file));
  std::vector<ImportedView> views;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    Result<ImportedView> view =
        ViewOf(frames[i], document, root / name, options.first_pixel);
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
