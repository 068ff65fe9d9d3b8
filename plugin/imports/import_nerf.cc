// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/scene.h>
#include <curvix/status.h>
#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/count_text.h"
#include "base/file_io.h"
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
  const Result<std::string> text = ReadFile(file);
  if (!text.ok()) return text.status();
  constexpr bool kThrow = false, kIgnoreComments = true;
  Json document = Json::parse(*text, nullptr, kThrow, kIgnoreComments);
  if (!document.is_object()) {
    return Status::DataLoss(file.string() +
                            " is not whole JSON in UTF-8 (NaN and Infinity "
                            "are not JSON, either); export it again.");
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

// `path` without its first `num` folders, or without all if it has fewer.
std::string WithoutFolders(const fs::path& path, std::ptrdiff_t num) {
  const auto num_folders = std::distance(path.begin(), path.end()) - 1;
  fs::path rest;
  for (auto part = std::next(path.begin(), std::min(num, num_folders));
       part != path.end();
       ++part) {
    rest /= *part;
  }
  return rest.generic_string();
}

// The names below `root` of the images at `paths` without their first
// `num_folders`, all different; those that are not there in `missing`.
std::vector<std::string> NamesWithout(std::ptrdiff_t num_folders,
                                      const std::vector<std::string>& paths,
                                      const fs::path& root,
                                      std::vector<std::string>* missing) {
  std::vector<std::string> names;
  std::set<std::string> found;
  for (const std::string& path : paths) {
    const std::string rest = WithoutFolders(path, num_folders);
    std::string name =
        CheckImageName(rest, root).ok() ? FindName(root, rest) : "";
    if (name.empty() || !found.insert(name).second) missing->push_back(path);
    names.push_back(std::move(name));
  }
  return names;
}

// The names of the frames' images below `root`. If `by_last_parts`, without as
// many first folders of their paths as it takes to find all, the fewest.
Result<std::vector<std::string>> FindNames(const Json& frames,
                                           const fs::path& root,
                                           bool by_last_parts,
                                           const fs::path& source) {
  std::vector<std::string> paths;
  std::ptrdiff_t num_tries = 1;
  for (const Json& frame : frames) {
    paths.push_back(FilePathOf(frame));
    const fs::path path(paths.back());
    const Status status = CheckImageName(path.filename().string(), source);
    if (!status.ok()) return status;
    if (!by_last_parts) continue;
    num_tries = std::max(num_tries, std::distance(path.begin(), path.end()));
  }
  std::vector<std::string> missing;
  for (std::ptrdiff_t num_folders = 0; num_folders < num_tries; ++num_folders) {
    missing.clear();
    std::vector<std::string> names =
        NamesWithout(num_folders, paths, root, &missing);
    if (missing.empty()) return names;
  }
  return Status::NotFound(
      std::to_string(missing.size()) + " of " + Plural(paths.size(), "image") +
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
