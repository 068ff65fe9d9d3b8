// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// Poses refined with curves, for a COLMAP model: the world keeps its place and
// its unit, and the points of the model have a say, too.
#pragma once

#include <curvix/refine_poses.h>
#include <curvix/scene.h>

#include <optional>
#include <string>

#include "plugin/colmap_model.h"
#include "plugin/pose_judgement.h"

namespace curvix {

// What was done, for report.json.
struct CurvePoseRecord {
  CurvePoses poses;
  double scale_removed = 1;         // by which the world had grown
  std::string largest_shift_image;  // name
  // Of the model's points, fitted to the poses before and after, if there are
  // enough to judge by.
  std::optional<PoseJudgement> points;
};

struct CurvePoseRefinement {
  // Set if the poses were accepted: `model` with new poses, points and their
  // errors; everything else as it was.
  std::optional<ColmapModel> model;
  CurvePoseRecord record;
};

// "50 views, 0.507 to 0.135 px, shifts up to 2.26 px": what was done, in a few
// words. The errors are mean ones, of places that were held out.
std::string CurvePosesText(const CurvePoseRecord& record);

// What RefinePosesWithCurves() has made of `scene` for `model`. The scene is
// that of the model, without the views whose images are missing. Refused, too,
// if points no longer fit: if their mean error rises by more than 1 %.
CurvePoseRefinement ModelWithCurvePoses(const ColmapModel& model,
                                        const Scene& scene,
                                        CurvePoses refined);

}  // namespace curvix
