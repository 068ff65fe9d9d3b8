// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// The six files of a COLMAP model as bytes: parsing and formatting, without
// file access, and the checks of their content. `file` is the path that error
// messages name. The parsers check the layout, and in text that the ids of
// images differ, ValidateColmapModel the other content; every count is checked
// against the bytes that are left before anything is allocated.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "colmap/colmap_model.h"

namespace curvix {

using CamerasOrError = Result<std::vector<ColmapCamera>>;
using ImagesOrError = Result<std::vector<ColmapImage>>;
using PointsOrError = Result<std::vector<ColmapPoint3D>>;

// Little endian, packed, no header.
CamerasOrError ParseCamerasBinary(std::string_view bytes,
                                  const std::string& file);
ImagesOrError ParseImagesBinary(std::string_view bytes,
                                const std::string& file);
PointsOrError ParsePointsBinary(std::string_view bytes,
                                const std::string& file);
std::string FormatCamerasBinary(const std::vector<ColmapCamera>& cameras);
std::string FormatImagesBinary(const std::vector<ColmapImage>& images);
std::string FormatPointsBinary(const std::vector<ColmapPoint3D>& points);

// Lines; '#' starts a comment line, blank lines are skipped except as the
// second line of an image, where they mean "no 2D points". An image's name is
// the rest of its line. Cameras of unknown models that are not used are left
// out. Not so in binary, where the model tells how long a camera is.
CamerasOrError ParseCamerasText(
    std::string_view bytes,
    const std::string& file,
    const std::function<bool(std::uint32_t camera_id)>& is_used);
ImagesOrError ParseImagesText(std::string_view bytes, const std::string& file);
PointsOrError ParsePointsText(std::string_view bytes, const std::string& file);

// The error for a camera model that is not supported, EQUIRECTANGULAR by name.
Status UnsupportedCameraModel(const std::string& file,
                              std::uint32_t camera_id,
                              const std::string& model);

// The rotation of COLMAP's quaternion (w, x, y, z), normalised. One that cannot
// be normalised is returned as all NaN, which ValidateColmapModel reports.
Eigen::Quaterniond RotationFromColmap(const std::array<double, 4>& wxyz);

// What makes a model unusable: the list that is at fault ("cameras", "images"
// or "points3D") and a sentence that says why and what to do.
struct ColmapFlaw {
  std::string list;
  std::string sentence;
};

// The first violation of what ValidateColmapModel promises; nullopt: none.
std::optional<ColmapFlaw> FindFlaw(const ColmapModel& model);

}  // namespace curvix
