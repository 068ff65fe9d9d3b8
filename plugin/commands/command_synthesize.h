// SPDX-License-Identifier: BSD-3-Clause
// Writes a synthetic scene as a COLMAP workspace.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <functional>

#include "synthetic/synthetic_scene.h"

namespace curvix {

// Writes MakeSyntheticScene(options) into `workspace`, which is made if needed:
//   images/view_000.png ...   8-bit RGB
//   sparse/0/*.bin            the COLMAP model: poses, one camera, and the
//                             sparse points that were asked for
//   gt.txt                    the exact curves, one sample a row:
//                             x y z tx ty tz curve_id views_seen views_edge
//                             kind, the number of its CurveKind
// kInvalidArgument, before anything is rendered or written, if an option is out
// of range, if images/ or sparse/ holds anything already, or if gt.txt exists.
// kCancelled if keep_going, which is asked after each view, returns false. All
// files appear together, or none does.
Status Synthesize(const SyntheticOptions& options,
                  const std::filesystem::path& workspace,
                  const std::function<bool()>& keep_going = {});

}  // namespace curvix
