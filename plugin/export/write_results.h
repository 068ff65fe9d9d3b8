// SPDX-License-Identifier: BSD-3-Clause
// The files of a run that hold its curves.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <string>
#include <vector>

#include "plugin/base/command_line.h"
#include "plugin/export/curves_json.h"

namespace curvix {

// Folders of results.
inline constexpr const char* kModelFolder = "sparse/";  // of refined poses
inline constexpr const char* kCurvesModelFolder = "curves_model/";
inline constexpr const char* kOverlaysFolder = "overlays/";

struct OutputSettings {
  std::vector<std::string> formats = {
      "ply", "obj", "pcd", "txt", "json", "csv", "html"};
  std::string svg_image;  // the view of curves.svg; "": the first one
  int num_overlays = 0;   // images with curves drawn over them
};

// A kind of file, and what it is for.
struct OutputFormat {
  const char* name;  // in --output_formats
  const char* file;  // in the output folder; ends in "/" for a folder
  const char* opened_by;
};

// All that there are, in the order in which they are written.
const std::vector<OutputFormat>& OutputFormats();

// The flags that change `settings`, which must outlive them.
FlagSection OutputFlags(OutputSettings* settings);

// kInvalidArgument: curves.svg is asked for, and svg_image is not the name of a
// view. Known before any curve.
Status CheckOutput(const OutputSettings& settings, const Scene& scene);

// Writes one of OutputFormats(), by its name, to `path`. Errors as
// WriteResults, and kInvalidArgument: a COLMAP model is asked for, and the
// source of the curves gives no edge behind them that is a number.
Status WriteFormat(const CurveRecord& record,
                   const OutputSettings& settings,
                   int num_threads,
                   const std::string& format,
                   const std::filesystem::path& path);

// Writes the files that `settings` ask for into `folder`, each whole or not at
// all, and returns their names. Overlays go to overlays/<image name>.png.
// kInvalidArgument: svg_image is not the name of a view; kNotFound: an image
// for an overlay cannot be read; errors of FileWriter.
Result<std::vector<std::string>> WriteResults(
    const CurveRecord& record,
    const OutputSettings& settings,
    int num_threads,
    const std::filesystem::path& folder);

}  // namespace curvix
