// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/importers.h"

#include <map>
#include <utility>

#include "colmap/files.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Status CheckSize(const fs::path& file, const Camera& camera) {
  const ImageSize of_camera = {camera.width, camera.height};
  const Result<ImageSize> size = ReadImageSize(file);
  if (!size.ok()) return size.status();
  if (*size == of_camera) return {};
  return Status::DataLoss(
      file.string() + " has " + SizeText(*size) + " pixels and its camera " +
      SizeText(of_camera) +
      "; name the folder of the images that the model was made of with "
      "--image_path.");
}

}  // namespace

Result<ImportedScene> ImportColmapImages(const ImportOptions& options) {
  const auto folder = FindImageFolder(options.image_path, {}, "");
  if (!folder.ok()) return folder.status();
  Result<ColmapModel> model = ReadColmapModel(options.input_path);
  if (!model.ok()) return model.status();
  std::map<std::uint32_t, Camera> cameras;
  for (const ColmapCamera& item : model->cameras) {
    cameras[item.camera_id] = item.camera;
  }
  std::vector<std::string> names;
  for (const ColmapImage& image : model->images) {
    Status status = CheckImageName(image.name, options.input_path);
    if (!status.ok()) return status;
    names.push_back(image.name);
  }
  if (names.empty()) return SceneOfViews({}, options.input_path);
  Status status = CheckImagesExist(names, *folder);
  if (!status.ok()) return status;
  ImportedScene scene;
  for (const ColmapImage& image : model->images) {
    const fs::path file = ImageFile(*folder, image.name);
    Status right = CheckSize(file, cameras.at(image.camera_id));
    if (!right.ok()) return right;
    scene.image_files.push_back(file);
  }
  scene.model = std::move(model).value();
  return scene;
}

}  // namespace curvix
