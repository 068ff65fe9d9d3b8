// SPDX-License-Identifier: BSD-3-Clause
// `colmap_curvix draw`: elevations, plans and sections to scale.
#pragma once

#include <curvix/status.h>
#include <string>

#include "plugin/base/progress.h"
#include "plugin/run/run_report.h"

namespace curvix {

struct DrawSettings {
  RunSettings run;             // paths and threads
  std::string plane = "auto";  // xy, xz, yz, several with commas between, or
                               // "nodes A B C"
  bool from_behind = false;
  std::string hidden = "dashed";  // or "omitted" or "solid"
  std::string slice;              // "FROM,TO", along the normal; "": all
  std::string crop;               // "LEFT,BOTTOM,RIGHT,TOP", as drawn; "all";
                                  // "": without what is far from the rest
  std::string scale;              // "1:50"; "": as fits
  std::string paper = "a3";
  bool dimensions = false;
  bool geopackage = false;
  bool geojson = false;
  std::string title;       // "": the name of the workspace
  std::string photograph;  // the name of an image, or "auto"; "": none
  // Of the files; "": drawing_<plane>[_section][_from_behind].
  std::string name;
};

// kInvalidArgument: settings that cannot work, whatever the curves.
Status Check(const DrawSettings& settings);

// Writes <name>.dxf and <name>.svg, and <name>.jpg, <name>.gpkg and
// <name>.geojson if they are asked for, into the folder of results, all or
// none. Returns what was drawn and where it is, for people. `settings` are as
// Check() wants them. kInvalidArgument: they do not suit the curves; errors of
// what is read.
Result<std::string> DrawWorkspace(const DrawSettings& settings,
                                  RunProgress& progress);

}  // namespace curvix
