// SPDX-License-Identifier: BSD-3-Clause
// Straight lines that other programs reconstructed, and curves made of them.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/scene.h>
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

struct LineCurves {
  CurveSet curves;
  std::vector<EdgeMap> edge_maps;  // one per view: what the samples refer to
  int num_left_out = 0;            // lines of length 0 or too far to be known
  int num_seen = 0;                // lines whose middle some view sees
  // References of lines to images that the scene does not have.
  int num_unknown_images = 0;
};

// A curve of two samples per line, in the order of the lines. A sample is
// supported by the views whose images show the line and in which it lies, by an
// edge where the view sees it, along the line: how far the edges of the image
// are from there is not known. Images that the scene does not have are left
// out. kInvalidArgument if no view sees any line: they are of another world.
Result<LineCurves> CurvesOfLines(const std::vector<ImportedLine>& lines,
                                 const Scene& scene);

}  // namespace curvix
