// SPDX-License-Identifier: BSD-3-Clause
// Straight lines that other programs reconstructed.
#pragma once

#include <curvix/status.h>
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace curvix {

struct ImportedLine {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  // world; finite
  Eigen::Vector3d end = Eigen::Vector3d::Zero();    // may be the start
  // Of the images that show it, with doubles, in the order of the file; empty:
  // the file does not tell.
  std::vector<std::uint32_t> image_ids;
};

// The lines of a program, in the order of its files. kNotFound: no such file,
// or the folder has none; kDataLoss: a broken file, with its line;
// kUnsupported: a file without lines.

// Line3D++: its .txt or .obj, or the folder that has one .txt of it.
Result<std::vector<ImportedLine>> ReadLine3dppLines(
    const std::filesystem::path& path);

// LIMAP: the folder of a run, its finaltracks/ or another folder of
// track_<i>.txt, alltracks.txt, or .obj.
Result<std::vector<ImportedLine>> ReadLimapLines(
    const std::filesystem::path& path);

}  // namespace curvix
