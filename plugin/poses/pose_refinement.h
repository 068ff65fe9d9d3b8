// SPDX-License-Identifier: BSD-3-Clause
// Better poses from the sparse points of the model, by the bundle adjuster of
// the user's COLMAP, or the poses as they were: whatever it does, the world
// keeps its place and its unit, and poses that are not better are not used.
#pragma once

#include <curvix/reconstruct.h>
#include <curvix/status.h>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "colmap/colmap_model.h"
#include "io/stage_io.h"
#include "plugin/base/command_line.h"
#include "plugin/poses/pose_judgement.h"

namespace curvix {

struct PoseRefinementSettings {
  std::string refiner = "colmap";        // or "none"
  std::filesystem::path colmap_path;     // the program; empty: found
  bool refine_intrinsics = true;         // with curves, if it proves better
  double refiner_timeout_s = 1800;       // COLMAP is ended after this
  bool refine_poses_with_curves = true;  // afterwards; see curve_poses.h
};

// Fewer points seen by two views are not enough to refine poses with.
inline constexpr std::size_t kMinPointsToRefine = 100;

// What was done, for report.json.
struct PoseRefinementRecord {
  std::string refiner = "none";  // the one that ran: "colmap", "none"
  std::string colmap_path;       // of the program, if it ran
  std::string colmap_version;    // "3.8"; "unknown"
  std::size_t num_views = 0;     // that took part
  std::size_t num_points = 0;    // that took part, those held out included
  double scale_removed = 1;      // by which the world had grown
  std::optional<PoseJudgement> judgement;  // if poses came out
  std::string largest_shift_image;         // name, if poses came out
  bool accepted = false;
  std::string reason;  // why, or why not
};

struct PoseRefinement {
  // Set if the poses were accepted: the input with new poses, points and their
  // errors; everything else as it was.
  std::optional<ColmapModel> model;
  PoseRefinementRecord record;
  std::vector<std::string> notes;  // sentences worth telling the user
};

// Gives the adjustment of `scene` by `program`: that of `adjust`, or one that
// an earlier run has kept of it.
using AdjustmentCache = std::function<Result<BundleAdjustment>(
    const Scene& scene,
    const std::filesystem::path& program,
    const std::function<Result<BundleAdjustment>()>& adjust)>;

// "COLMAP 3.8, 24 views, 1.08 to 0.42 px, shifts up to 2.3 px": what was done,
// in a few words. The errors are mean ones, of the points that were held out.
std::string PoseRefinementText(const PoseRefinementRecord& record);

// The command line's options that set `settings`, which must outlive them.
FlagSection PoseRefinementFlags(PoseRefinementSettings* settings);

// Refines the poses of `model`. A COLMAP that is missing or that fails in any
// way, and a model without points, are told in `notes` and leave the poses as
// they were. COLMAP's output goes to `log_path`. `progress` is called as stage
// "refine_poses". kCancelled when it returns false. `cache`: may be empty.
Result<PoseRefinement> RefinePoses(const ColmapModel& model,
                                   const PoseRefinementSettings& settings,
                                   const std::filesystem::path& log_path,
                                   const Progress& progress,
                                   const AdjustmentCache& cache = {});

}  // namespace curvix
