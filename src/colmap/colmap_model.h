// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// COLMAP's sparse models on disk: cameras, images and points3D as .bin or .txt.
//
// Read: what COLMAP 3.6 to 4.x writes. rigs.* and frames.* are ignored, since
// images.* holds the composed poses too. Written: .bin in the layout that all
// of these versions read, without rigs and frames.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace curvix {

// The point3D_id of a 2D point that no 3D point explains.
inline constexpr std::uint64_t kNoPoint3D =
    std::numeric_limits<std::uint64_t>::max();

struct ColmapCamera {
  std::uint32_t camera_id = 0;
  Camera camera;
};

struct ColmapPoint2D {
  double x = 0;  // pixels
  double y = 0;
  std::uint64_t point3D_id = kNoPoint3D;
};

// A registered image.
struct ColmapImage {
  std::uint32_t image_id = 0;
  Rigid3 cam_from_world;
  std::uint32_t camera_id = 0;
  std::string name;  // relative to the image folder, '/' between folders
  std::vector<ColmapPoint2D> points2D;
};

// Where a 3D point is seen: the point2D_idx-th 2D point of an image.
struct ColmapTrackElement {
  std::uint32_t image_id = 0;
  std::uint32_t point2D_idx = 0;
};

struct ColmapPoint3D {
  std::uint64_t point3D_id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::array<std::uint8_t, 3> rgb = {0, 0, 0};
  double error = -1;  // mean reprojection error, pixels; -1: not computed
  std::vector<ColmapTrackElement> track;
};

// Each list is sorted by id when it comes from ReadColmapModel.
struct ColmapModel {
  std::vector<ColmapCamera> cameras;
  std::vector<ColmapImage> images;
  std::vector<ColmapPoint3D> points;  // may be empty: known poses only
};

enum class ColmapFormat { kBinary, kText };

// The format in which ReadColmapModel would read `folder`: the first of .bin
// and .txt of which all three files are there, else the first of which cameras
// and images are there. kNotFound: neither.
Result<ColmapFormat> FindColmapFormat(const std::filesystem::path& folder);

// How many images the model in `folder` has registered; 0 if there is no model
// or its images cannot be read.
std::size_t CountColmapImages(const std::filesystem::path& folder);

// Reads the model in `folder`. A missing points3D file, or an empty
// points3D.txt, means no points. Quaternions are normalised. Broken cameras
// that no image uses are left out, in text those of unknown models, too. The
// result satisfies ValidateColmapModel. Errors name the file: kNotFound (no
// model), kDataLoss (truncated, malformed, inconsistent), kUnsupported (camera
// model).
Result<ColmapModel> ReadColmapModel(const std::filesystem::path& folder);

// Writes `model` into `folder`, which is made if needed, as .bin, each file
// whole or not at all. kDataLoss if the model is not valid; kInvalidArgument if
// the folder holds rigs, frames or files in .txt, which COLMAP would read
// instead of these.
Status WriteColmapModel(const ColmapModel& model,
                        const std::filesystem::path& folder);

// kDataLoss unless ids and image names are unique, cameras valid and known,
// poses and points finite, and names stay inside the image folder (relative,
// without ".."). Tracks may refer to images that are not there: some tools
// remove images and leave the points.
Status ValidateColmapModel(const ColmapModel& model);

// Whether the name of an image is empty, absolute or holds "..", and so may
// lead out of the image folder on some system.
bool LeavesImageFolder(std::string_view name);

// The scene of a valid model: cameras in the model's order, views sorted by
// name with image_path = image_folder / name, without the images whose names
// are in `left_out` (sorted). Points keep the views that are there; those
// without any are left out.
Scene SceneFromColmapModel(const ColmapModel& model,
                           const std::filesystem::path& image_folder,
                           const std::vector<std::string>& left_out = {});

// Adds a 2D point to the image, and to the track of the point that it shows.
void AddObservation(const Eigen::Vector2d& pixel,
                    ColmapImage& image,
                    ColmapPoint3D& point);

// A scene as COLMAP would have it, and its cameras and images alone. The id of
// a camera or a point is its index and one; pixels that are not known are left
// out.
ColmapModel ModelOfScene(const Scene& scene);
ColmapModel ModelOfViews(const Scene& scene);

}  // namespace curvix
