// SPDX-License-Identifier: BSD-3-Clause
// `colmap_curvix align`: finds scale and axes, and writes alignment.json.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <string>

#include "plugin/base/progress.h"
#include "plugin/run/run_report.h"

namespace curvix {

struct AlignSettings {
  RunSettings run;        // paths and threads
  std::string distances;  // as ParseDistances takes them; "": none
  std::string markers;    // a dictionary; "": none
  double marker_size = 0;
  std::filesystem::path positions_path;
  std::string epsg;           // "": none
  std::string axes = "none";  // or "auto"
  std::string up;             // x,y,z in the frame of curves.json; "": cameras'
  std::string unit = "none";
  // The run is repeated once this has worked, and tells the notes on the input.
  bool run_follows = false;
};

// kInvalidArgument: settings that cannot work, whatever the results.
Status Check(const AlignSettings& settings);

// Returns what was found, for people. The model is that with refined poses, if
// a run has left one. `settings` are as Check() wants them. kInvalidArgument:
// they do not suit the results. Errors of what is read and written.
Result<std::string> AlignWorkspace(const AlignSettings& settings,
                                   RunProgress& progress);

}  // namespace curvix
