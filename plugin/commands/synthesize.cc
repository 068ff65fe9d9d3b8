// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/commands/synthesize.h"

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/file_io.h"
#include "base/text_fields.h"
#include "colmap/colmap_model.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// kInvalidArgument if `path` is a file, or a folder with something in it.
Status CheckUnused(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  if (fs::is_directory(path, error) && fs::is_empty(path, error)) return {};
  return {StatusCode::kInvalidArgument,
          path.string() +
              " is there already and would be overwritten; name another "
              "--workspace_path or remove it first"};
}

Status MakeFolder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!error) return {};
  return {StatusCode::kInvalidArgument,
          "cannot make the folder " + path.string() + ": " + error.message()};
}

Status WriteImage(const RgbImage& image, const fs::path& path) {
  std::vector<std::uint8_t> bgr = image.pixels;
  for (std::size_t i = 0; i + 2 < bgr.size(); i += 3) {
    std::swap(bgr[i], bgr[i + 2]);
  }
  const cv::Mat picture(image.height, image.width, CV_8UC3, bgr.data());
  std::vector<unsigned char> png;
  try {
    if (!cv::imencode(".png", picture, png)) png.clear();
  } catch (const cv::Exception&) {
    png.clear();
  }
  if (png.empty()) {
    return {StatusCode::kInternal, "cannot encode " + path.string()};
  }
  return WriteFileAtomically(path, std::string(png.begin(), png.end()));
}

// As COLMAP would find it: each sight of a point is a 2D point of its image.
ColmapModel ModelOf(const SyntheticScene& synthetic) {
  const Scene& scene = synthetic.scene;
  ColmapModel model;
  for (const Camera& camera : scene.cameras) {
    const auto id = static_cast<std::uint32_t>(model.cameras.size() + 1);
    model.cameras.push_back({id, camera});
  }
  for (const View& view : scene.views) {
    ColmapImage image;
    image.image_id = view.image_id;
    image.cam_from_world = view.cam_from_world;
    image.camera_id = static_cast<std::uint32_t>(view.camera_idx + 1);
    image.name = view.name;
    model.images.push_back(std::move(image));
  }
  for (const TruePoint& point : synthetic.points) {
    ColmapPoint3D point3D;
    point3D.point3D_id = model.points.size() + 1;
    point3D.position = point.position;
    for (const TruePoint::Sight& sight : point.sights) {
      ColmapImage& image =
          model.images[static_cast<std::size_t>(sight.view_idx)];
      point3D.track.push_back(
          {image.image_id, static_cast<std::uint32_t>(image.points2D.size())});
      image.points2D.push_back(
          {sight.pixel.x(), sight.pixel.y(), point3D.point3D_id});
    }
    model.points.push_back(std::move(point3D));
  }
  return model;
}

std::string TruthText(const std::vector<TrueSample>& samples) {
  std::string text;
  for (const TrueSample& sample : samples) {
    for (const Eigen::Vector3d& vector : {sample.position, sample.tangent}) {
      for (int axis = 0; axis < 3; ++axis) {
        AppendNumber(vector[axis], text);
        text += ' ';
      }
    }
    text += std::to_string(sample.curve_id) + ' ' +
            std::to_string(sample.num_views_seen) + ' ' +
            std::to_string(sample.num_views_edge) + ' ' +
            std::to_string(static_cast<int>(sample.kind)) + '\n';
  }
  return text;
}

}  // namespace

Status Synthesize(const SyntheticOptions& options, const fs::path& workspace) {
  const fs::path images = workspace / "images";
  const fs::path sparse = workspace / "sparse";
  const fs::path truth = workspace / "gt.txt";
  for (const fs::path& path : {images, sparse, truth}) {
    if (Status status = CheckUnused(path); !status.ok()) return status;
  }
  const Result<SyntheticScene> scene = MakeSyntheticScene(options);
  if (!scene.ok()) return scene.status();

  if (Status status = MakeFolder(images); !status.ok()) return status;
  for (std::size_t i = 0; i < scene->images.size(); ++i) {
    const fs::path path = images / scene->scene.views[i].name;
    Status status = WriteImage(scene->images[i], path);
    if (!status.ok()) return status;
  }
  Status status =
      WriteColmapModel(ModelOf(*scene), sparse / "0", ColmapFormat::kBinary);
  if (!status.ok()) return status;
  return WriteFileAtomically(truth, TruthText(scene->truth));
}

}  // namespace curvix
