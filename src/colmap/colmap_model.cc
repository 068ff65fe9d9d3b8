// SPDX-License-Identifier: BSD-3-Clause
#include "colmap/colmap_model.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include "base/file_io.h"
#include "base/text_fields.h"
#include "colmap/colmap_model_format.h"
#include "colmap/files.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

std::string Extension(ColmapFormat format) {
  return format == ColmapFormat::kBinary ? ".bin" : ".txt";
}

fs::path FilePath(const fs::path& folder,
                  const std::string& list,
                  ColmapFormat format) {
  return folder / (list + Extension(format));
}

// Reads and parses one file of the model.
template <typename List, typename Parse>
Result<List> ReadList(const fs::path& path, const Parse& parse) {
  CURVIX_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  return parse(bytes, path.string());
}

ImagesOrError ReadImages(const fs::path& folder, ColmapFormat format) {
  return ReadList<std::vector<ColmapImage>>(
      FilePath(folder, "images", format),
      format == ColmapFormat::kBinary ? ParseImagesBinary : ParseImagesText);
}

PointsOrError ReadPoints(const fs::path& path, ColmapFormat format) {
  std::error_code error;
  if (!fs::exists(path, error)) return std::vector<ColmapPoint3D>();
  return ReadList<std::vector<ColmapPoint3D>>(
      path,
      format == ColmapFormat::kBinary ? ParsePointsBinary : ParsePointsText);
}

void SortById(ColmapModel* model) {
  std::ranges::stable_sort(model->cameras, {}, &ColmapCamera::camera_id);
  std::ranges::stable_sort(model->images, {}, &ColmapImage::image_id);
  std::ranges::stable_sort(model->points, {}, &ColmapPoint3D::point3D_id);
}

// Programs that split or filter models leave cameras without images, which may
// be broken: nobody looks at them.
CamerasOrError ReadUsableCameras(const fs::path& path,
                                 ColmapFormat format,
                                 const std::vector<ColmapImage>& images) {
  std::set<std::uint32_t> used;
  for (const ColmapImage& image : images) used.insert(image.camera_id);
  const auto is_used = [&](std::uint32_t id) { return used.contains(id); };
  CamerasOrError cameras = ReadList<std::vector<ColmapCamera>>(
      path, [&](std::string_view bytes, const std::string& file) {
        return format == ColmapFormat::kBinary
                   ? ParseCamerasBinary(bytes, file)
                   : ParseCamerasText(bytes, file, is_used);
      });
  if (!cameras.ok()) return cameras;
  std::erase_if(*cameras, [&](const ColmapCamera& item) {
    return !is_used(item.camera_id) && !Validate(item.camera).ok();
  });
  return cameras;
}

// Files in `folder` that COLMAP or we would read instead of, or together with,
// a model in .bin.
Status RefuseForeignFiles(const fs::path& folder) {
  for (const std::string_view name :
       SplitAt("rigs.bin rigs.txt frames.bin frames.txt cameras.txt images.txt "
               "points3D.txt",
               ' ')) {
    if (IsFile(folder / name)) {
      return Status::InvalidArgument(
          "Cannot write a model to " + folder.string() + ": it holds " +
          std::string(name) + " of another model; choose an empty folder.");
    }
  }
  return {};
}

// A view of the scene and its image in the model.
struct SceneView {
  int view_idx = 0;
  const ColmapImage* image = nullptr;
};

Eigen::Vector2d PixelOf(const ColmapImage& image, std::size_t point2D_idx) {
  if (point2D_idx >= image.points2D.size()) {
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  return {image.points2D[point2D_idx].x, image.points2D[point2D_idx].y};
}

// Without images that are no views; of several places in one image the first.
ScenePoint MakeScenePoint(const ColmapPoint3D& point,
                          const std::map<std::uint32_t, SceneView>& views) {
  std::map<int, Eigen::Vector2d> pixels;
  for (const ColmapTrackElement& element : point.track) {
    const auto found = views.find(element.image_id);
    if (found == views.end()) continue;
    const auto& [view_idx, image] = found->second;
    pixels.emplace(view_idx, PixelOf(*image, element.point2D_idx));
  }
  ScenePoint scene_point;
  scene_point.position = point.position;
  scene_point.point3D_id = point.point3D_id;
  for (const auto& [view_idx, pixel] : pixels) {
    scene_point.view_idxs.push_back(view_idx);
    scene_point.pixels.push_back(pixel);
  }
  return scene_point;
}

}  // namespace

Status UnsupportedCameraModel(const std::string& file,
                              std::uint32_t camera_id,
                              const std::string& model) {
  const std::string why =
      model == "EQUIRECTANGULAR"
          ? "which has no pinhole image; render its panoramas into perspective "
            "views first."
          : "which this program does not know; convert the images with "
            "'colmap image_undistorter' and use its output.";
  return Status::Unsupported(file + ": camera " + std::to_string(camera_id) +
                             " has the camera model " + model + ", " + why);
}

Eigen::Quaterniond RotationFromColmap(const std::array<double, 4>& wxyz) {
  Eigen::Quaterniond q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  // Not normalize(), which leaves zero as it is.
  q.coeffs() /= q.coeffs().stableNorm();
  return q;
}

Result<ColmapFormat> FindColmapFormat(const fs::path& folder) {
  constexpr ColmapFormat kFormats[] = {ColmapFormat::kBinary,
                                       ColmapFormat::kText};
  const auto has_poses = [&](ColmapFormat format) {
    return IsFile(FilePath(folder, "cameras", format)) &&
           IsFile(FilePath(folder, "images", format));
  };
  for (const ColmapFormat format : kFormats) {
    if (has_poses(format) && IsFile(FilePath(folder, "points3D", format))) {
      return format;
    }
  }
  for (const ColmapFormat format : kFormats) {
    if (has_poses(format)) return format;
  }
  return Status::NotFound(folder.string() +
                          " holds no COLMAP model: cameras and images are "
                          "needed, both as .bin or both as .txt.");
}

std::size_t CountColmapImages(const fs::path& folder) {
  const Result<ColmapFormat> format = FindColmapFormat(folder);
  if (!format.ok()) return 0;
  const ImagesOrError images = ReadImages(folder, *format);
  return images.ok() ? images->size() : 0;
}

Result<ColmapModel> ReadColmapModel(const fs::path& folder) {
  CURVIX_ASSIGN_OR_RETURN(const ColmapFormat format, FindColmapFormat(folder));
  CURVIX_ASSIGN_OR_RETURN(std::vector<ColmapImage> images,
                          ReadImages(folder, format));
  CURVIX_ASSIGN_OR_RETURN(
      std::vector<ColmapCamera> cameras,
      ReadUsableCameras(FilePath(folder, "cameras", format), format, images));
  CURVIX_ASSIGN_OR_RETURN(
      std::vector<ColmapPoint3D> points,
      ReadPoints(FilePath(folder, "points3D", format), format));
  ColmapModel model{std::move(cameras), std::move(images), std::move(points)};
  SortById(&model);
  if (const std::optional<ColmapFlaw> flaw = FindFlaw(model)) {
    return Status::DataLoss(FilePath(folder, flaw->list, format).string() +
                            ": " + flaw->sentence);
  }
  return model;
}

Status WriteColmapModel(const ColmapModel& model, const fs::path& folder) {
  CURVIX_RETURN_IF_ERROR(ValidateColmapModel(model));
  CURVIX_RETURN_IF_ERROR(RefuseForeignFiles(folder));
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return Status::InvalidArgument("Cannot make the folder " + folder.string() +
                                   " (" + error.message() +
                                   "); choose one that may be written.");
  }
  const std::pair<const char*, std::string> files[] = {
      {"cameras.bin", FormatCamerasBinary(model.cameras)},
      {"images.bin", FormatImagesBinary(model.images)},
      {"points3D.bin", FormatPointsBinary(model.points)},
  };
  for (const auto& [name, bytes] : files) {
    CURVIX_RETURN_IF_ERROR(WriteFileAtomically(folder / name, bytes));
  }
  return {};
}

Scene SceneFromColmapModel(const ColmapModel& model,
                           const fs::path& image_folder,
                           const std::vector<std::string>& left_out) {
  Scene scene;
  std::map<std::uint32_t, int> camera_idxs;
  for (const ColmapCamera& item : model.cameras) {
    camera_idxs[item.camera_id] = static_cast<int>(scene.cameras.size());
    scene.cameras.push_back(item.camera);
  }
  std::vector<const ColmapImage*> images;
  for (const ColmapImage& image : model.images) {
    if (std::ranges::binary_search(left_out, image.name)) continue;
    images.push_back(&image);
  }
  std::ranges::sort(images, {}, &ColmapImage::name);
  std::map<std::uint32_t, SceneView> views;
  for (const ColmapImage* image : images) {
    views[image->image_id] = {static_cast<int>(scene.views.size()), image};
    scene.views.push_back({image->name,
                           ImageFile(image_folder, image->name),
                           image->image_id,
                           camera_idxs.at(image->camera_id),
                           image->cam_from_world,
                           {},
                           std::nullopt});
  }
  for (const ColmapPoint3D& point : model.points) {
    ScenePoint scene_point = MakeScenePoint(point, views);
    if (scene_point.view_idxs.empty()) continue;
    scene.points.push_back(std::move(scene_point));
  }
  return scene;
}

void AddObservation(const Eigen::Vector2d& pixel,
                    ColmapImage& image,
                    ColmapPoint3D& point) {
  point.track.push_back(
      {image.image_id, static_cast<std::uint32_t>(image.points2D.size())});
  image.points2D.push_back({pixel.x(), pixel.y(), point.point3D_id});
}

ColmapModel ModelOfViews(const Scene& scene) {
  ColmapModel model;
  for (const Camera& camera : scene.cameras) {
    const auto id = static_cast<std::uint32_t>(model.cameras.size() + 1);
    model.cameras.push_back({id, camera});
  }
  for (const View& view : scene.views) {
    model.images.push_back({view.image_id,
                            view.cam_from_world,
                            static_cast<std::uint32_t>(view.camera_idx + 1),
                            view.name,
                            {}});
  }
  return model;
}

ColmapModel ModelOfScene(const Scene& scene) {
  ColmapModel model = ModelOfViews(scene);
  for (const ScenePoint& point : scene.points) {
    ColmapPoint3D made;
    made.point3D_id = model.points.size() + 1;
    made.position = point.position;
    for (std::size_t i = 0; i < point.pixels.size(); ++i) {
      if (!point.pixels[i].allFinite()) continue;
      AddObservation(point.pixels[i],
                     model.images[static_cast<std::size_t>(point.view_idxs[i])],
                     made);
    }
    model.points.push_back(std::move(made));
  }
  return model;
}

}  // namespace curvix
