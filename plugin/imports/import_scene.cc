// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/import_scene.h"

#include <algorithm>

#include "base/count_text.h"
#include "base/file_io.h"
#include "base/text_fields.h"
#include "colmap/files.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// The id of `camera` in the model, to which it is added if it is new.
std::uint32_t CameraId(const Camera& camera, ColmapModel* model) {
  // Backwards: a camera is mostly that of the view before.
  const auto same = std::find_if(
      model->cameras.rbegin(), model->cameras.rend(), [&](const auto& item) {
        return item.camera == camera;
      });
  if (same != model->cameras.rend()) return same->camera_id;
  const auto id = static_cast<std::uint32_t>(model->cameras.size() + 1);
  model->cameras.push_back({id, camera});
  return id;
}

bool IsImageName(const std::string& name) {
  static const auto extensions =
      SplitAt(".png .jpg .jpeg .tif .tiff .bmp .ppm .pgm .webp", ' ');
  return std::ranges::find(extensions, ExtensionOf(name)) != extensions.end();
}

Result<ImportedView> CalibratedView(const CalibratedImage& image,
                                    const fs::path& folder,
                                    double first_pixel) {
  const fs::path file = folder / image.name;
  CURVIX_ASSIGN_OR_RETURN(const ImageSize size, ReadImageSize(file));
  const Result<Camera> camera = CameraFromCalibration(
      image.pose.calibration, size.width, size.height, first_pixel);
  if (!camera.ok()) {
    return Status(camera.status().code(),
                  image.source + ": " + camera.status().message());
  }
  return ImportedView{image.name, file, *camera, image.pose.cam_from_world};
}

}  // namespace

Result<ImportedScene> SceneOfViews(const std::vector<ImportedView>& views,
                                   const fs::path& source) {
  if (views.empty()) {
    return Status::DataLoss(source.string() +
                            " describes no images; name the file that holds "
                            "the cameras with --input_path.");
  }
  ImportedScene scene;
  for (const ImportedView& view : views) {
    CURVIX_RETURN_IF_ERROR(CheckImageName(view.name, source));
    ColmapImage image;
    image.image_id = static_cast<std::uint32_t>(scene.image_files.size() + 1);
    image.cam_from_world = view.cam_from_world;
    image.camera_id = CameraId(view.camera, &scene.model);
    image.name = view.name;
    scene.model.images.push_back(std::move(image));
    scene.image_files.push_back(view.file);
  }
  const Status status = ValidateColmapModel(scene.model);
  if (!status.ok()) {
    return Status(status.code(), source.string() + ": " + status.message());
  }
  return scene;
}

Result<ImportedScene> SceneOfImages(const std::vector<CalibratedImage>& images,
                                    const fs::path& folder,
                                    double first_pixel,
                                    const fs::path& source) {
  std::vector<ImportedView> views;
  for (const CalibratedImage& image : images) {
    CURVIX_ASSIGN_OR_RETURN(ImportedView view,
                            CalibratedView(image, folder, first_pixel));
    views.push_back(std::move(view));
  }
  return SceneOfViews(views, source);
}

Status CheckImageName(const std::string& name, const fs::path& source) {
  const bool has_control = std::ranges::any_of(name, [](char c) {
    return std::iscntrl(static_cast<unsigned char>(c)) != 0;
  });
  if (!has_control && !LeavesImageFolder(name)) return {};
  return Status::DataLoss(source.string() + " names an image \"" +
                          (has_control ? "with control characters" : name) +
                          "\", but names must be relative to the image folder "
                          "and stay in it; correct the name.");
}

Status CheckImagesExist(const std::vector<std::string>& names,
                        const fs::path& folder) {
  std::vector<std::string> missing;
  for (const std::string& name : names) {
    if (!IsFile(ImageFile(folder, name))) missing.push_back(name);
  }
  if (missing.empty()) return {};
  return Status::NotFound(
      std::to_string(missing.size()) + " of " + Plural(names.size(), "image") +
      OneOrMore(missing.size(), " is", " are") + " not in " + folder.string() +
      " (" + FirstNames(missing) +
      "); name their folder with --image_path, or remove their cameras.");
}

Result<fs::path> FindImageFolder(const fs::path& image_path,
                                 const std::vector<fs::path>& places,
                                 const std::string& name) {
  if (!image_path.empty()) {
    if (IsFolder(image_path)) return image_path;
    return Status::NotFound("--image_path " + image_path.string() +
                            " is not a folder; name the folder of the images.");
  }
  // Files that are named without a folder are in the current one.
  const auto folder = [](const fs::path& place) {
    return place.empty() ? fs::path(".") : place;
  };
  for (const fs::path& place : places) {
    if (IsFile(place / name)) return folder(place);
  }
  return folder(places.front());
}

std::vector<std::string> FileNames(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::path& path : EntriesOf(folder)) {
    if (IsFile(path)) names.push_back(path.filename().string());
  }
  return names;
}

std::vector<std::string> ImageNames(const fs::path& folder,
                                    const std::string& filter) {
  std::vector<std::string> names = FileNames(folder);
  std::erase_if(names, [&](const std::string& name) {
    // "._a.png" is what macOS keeps about "a.png".
    return !IsImageName(name) || name.starts_with('.') ||
           name.find(filter) == std::string::npos;
  });
  return names;
}

Result<fs::path> OnlyFile(const fs::path& folder,
                          const std::string& prefix,
                          const std::string& suffix) {
  std::vector<std::string> names = FileNames(folder);
  std::erase_if(names, [&](const std::string& name) {
    return !name.starts_with(prefix) || !name.ends_with(suffix);
  });
  if (names.size() == 1) return folder / names.front();
  const std::string pattern = prefix + "*" + suffix;
  return Status::NotFound(
      names.empty()
          ? folder.string() + " holds no " + pattern +
                "; name the file of the cameras with --input_path."
          : folder.string() + " holds several files " + pattern + " (" +
                FirstNames(names) + "); name one of them with --input_path.");
}

}  // namespace curvix
