// SPDX-License-Identifier: BSD-3-Clause
// Where cameras are, as GPS or a survey says, and in which coordinate system.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <filesystem>
#include <string>
#include <vector>

#include "measuring/world_alignment.h"

namespace curvix {

struct CameraPositions {
  std::vector<KnownPosition> positions;  // in the order of the file
  std::vector<std::string> notes;        // of names that no view has
};

// A line "name x y z" or "name x y z sigma" per image, blanks, commas or
// semicolons between; "#" begins a comment. Names may hold all of these and be
// in quotes: of several meanings of a line, the one whose name a view has
// counts. The model's position is the centre of the camera. kNotFound;
// kDataLoss: the line that cannot be read, a name that is there twice, or no
// name that a view has.
Result<CameraPositions> ReadPositions(const std::filesystem::path& path,
                                      const Scene& scene);

// kInvalidArgument unless `code` is the number of a coordinate system of EPSG
// whose coordinates are metres, as far as GDAL knows; without GDAL, unless it
// is a number of one.
Status CheckEpsg(const std::string& code);

}  // namespace curvix
