// SPDX-License-Identifier: BSD-3-Clause
// Where cameras are, as GPS or a survey says, in which coordinate system, and
// whether these are the positions of the cameras.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <cstddef>
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

// Above it, something that is given is wrong (AlignmentResult::misfit).
inline constexpr double kLargeMisfit = 3;

// Means over the cameras, in the frame of the model.
struct MeanDirections {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();       // MeanUp()
  Eigen::Vector3d forward = Eigen::Vector3d::Zero();  // MeanViewDirection()
};

// Of the positions, one or more: by how much they are off, root mean square,
// world units; and the index of the one that is furthest off.
double RmsOf(const AlignmentResult& result);
std::size_t WorstOf(const AlignmentResult& result);

// Whether positions turn the cameras upside down, or turn cameras that look
// down to the sky, in a world whose z is up.
bool AreUpsideDown(const AlignmentResult& result,
                   const MeanDirections& cameras);

// kInvalidArgument, with a sentence that says what to look for: the positions
// are far off, fit much better with x and y swapped, or, if `z_is_up`, turn the
// cameras upside down. Positions whose sigmas allow it may be far off. Without
// positions, all is well.
Status CheckPositions(const AlignmentInput& input,
                      const AlignmentResult& result,
                      const MeanDirections& cameras,
                      bool z_is_up);

}  // namespace curvix
