// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "plugin/imports/import_nerf.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "base/file_io.h"
#include "plugin/imports/nerf_camera.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

Result<json> ReadTransforms(const fs::path& file) {
  const Result<std::string> text = ReadFile(file);
  if (!text.ok()) return text.status();
  json document = json::parse(*text, nullptr, false);
  if (!document.is_object()) {
    return Status(StatusCode::kDataLoss,
                  file.string() +
                      " is not JSON that can be read (NaN and "
                      "Infinity are not JSON); export it again.");
  }
  const auto frames = document.find("frames");
  const bool usable =
      frames != document.end() && frames->is_array() &&
      std::all_of(frames->begin(), frames->end(), [](const json& frame) {
        return frame.is_object() && frame.contains("file_path") &&
               frame["file_path"].is_string();
      });
  if (usable) return document;
  return Status(StatusCode::kDataLoss,
                file.string() +
                    " has no list of frames that each have a "
                    "file_path; export it again.");
}

// The frame's file_path with '/' between folders, without "./".
std::string FilePathOf(const json& frame) {
  std::string text = frame["file_path"].get<std::string>();
  std::replace(text.begin(), text.end(), '\\', '/');
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
Result<std::vector<std::string>> FindNames(const json& frames,
                                           const fs::path& root,
                                           bool by_last_part,
                                           const fs::path& source) {
  std::vector<std::string> names;
  std::vector<std::string> missing;
  for (const json& frame : frames) {
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
  return Status(StatusCode::kNotFound,
                std::to_string(missing.size()) + " of " +
                    std::to_string(names.size()) + " images are not in " +
                    root.string() + " (" + FirstNames(missing) +
                    "); name their folder with --image_path.");
}

Result<ImportedView> ViewOf(const json& frame,
                            const json& document,
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
  if (!fs::is_directory(input_path)) return input_path;
  const fs::path train = input_path / "transforms_train.json";
  const fs::path all = input_path / "transforms.json";
  return !IsFile(all) && IsFile(train) ? train : all;
}

}  // namespace

Result<ImportedScene> ImportNerf(const ImportOptions& options) {
  const fs::path file = TransformsFile(options.input_path);
  const Result<json> document = ReadTransforms(file);
  if (!document.ok()) return document.status();
  const json& frames = (*document)["frames"];
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
