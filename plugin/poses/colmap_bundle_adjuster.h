// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment by the user's COLMAP. It may move and scale the world.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <filesystem>
#include <functional>
#include <string>

#include "io/stage_io.h"

namespace curvix {

// Asked many times a second; false: stop.
using KeepGoing = std::function<bool()>;

// The user's COLMAP: `given` if not empty, else $COLMAP_EXE_PATH/colmap, else
// colmap in $PATH. kNotFound: a sentence that says what to install.
Result<std::filesystem::path> FindColmap(const std::filesystem::path& given);

struct ColmapRun {
  std::filesystem::path program;
  double timeout_s = 0;
  std::filesystem::path log_path;  // takes what COLMAP says
};

// Adjusts poses and points of `scene` by `colmap bundle_adjuster`; cameras
// stay. Points that it drops stay, too. It has no robust loss, so outliers are
// left out. Options are those that COLMAP 3.6 to 4.x know, and its function
// tolerance under the name that its help has. `version` is set as soon as
// COLMAP answers: "3.8", from the first lines of its help; "unknown" if they
// are not COLMAP's. kExternalTool, with a sentence that says what went wrong:
// it could not be started, failed, took too long, or wrote no model with the
// same images and cameras. kCancelled when keep_going says so;
// kInvalidArgument: no room for temporary files.
Result<BundleAdjustment> RefineWithColmap(const Scene& scene,
                                          const ColmapRun& run,
                                          const KeepGoing& keep_going,
                                          std::string* version);

}  // namespace curvix
