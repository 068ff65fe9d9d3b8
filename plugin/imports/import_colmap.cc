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
  CURVIX_ASSIGN_OR_RETURN(const ImageSize size, ReadImageSize(file));
  if (size == of_camera) return {};
  return Status::DataLoss(
      file.string() + " has " + SizeText(size) + " pixels and its camera " +
      SizeText(of_camera) +
      "; name the folder of the images that the model was made of with "
      "--image_path.");
}

}  // namespace

Result<ImportedScene> ImportColmapImages(const ImportOptions& options) {
  CURVIX_ASSIGN_OR_RETURN(const auto folder,
                          FindImageFolder(options.image_path, {}, ""));
  CURVIX_ASSIGN_OR_RETURN(ColmapModel model,
                          ReadColmapModel(options.input_path));
  std::map<std::uint32_t, Camera> cameras;
  for (const ColmapCamera& item : model.cameras) {
    cameras[item.camera_id] = item.camera;
  }
  std::vector<std::string> names;
  for (const ColmapImage& image : model.images) {
    CURVIX_RETURN_IF_ERROR(CheckImageName(image.name, options.input_path));
    names.push_back(image.name);
  }
  if (names.empty()) return SceneOfViews({}, options.input_path);
  CURVIX_RETURN_IF_ERROR(CheckImagesExist(names, folder));
  ImportedScene scene;
  for (const ColmapImage& image : model.images) {
    const fs::path file = ImageFile(folder, image.name);
    CURVIX_RETURN_IF_ERROR(CheckSize(file, cameras.at(image.camera_id)));
    scene.image_files.push_back(file);
  }
  scene.model = std::move(model);
  return scene;
}

}  // namespace curvix
