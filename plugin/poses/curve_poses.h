// SPDX-License-Identifier: BSD-3-Clause
// Poses and cameras refined with curves, for a COLMAP model: the world keeps
// its place and its unit.
#pragma once

#include <curvix/refine_poses.h>
#include <curvix/scene.h>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "colmap/colmap_model.h"

namespace curvix {

// A camera of the model, refined.
struct CameraChange {
  std::uint32_t camera_id = 0;
  Camera from;
  Camera to;
  // By how much pixels of its images shift, the change that a turn of the
  // camera would make taken off: the median over the image. Pixels.
  double median_shift_px = 0;
};

// What was done, for report.json.
struct CurvePoseRecord {
  CurvePoses poses;
  std::string largest_shift_image;    // name
  std::vector<CameraChange> cameras;  // those that changed
};

struct CurvePoseRefinement {
  // Set if the poses were accepted: `model` with new poses, points and their
  // errors; everything else as it was.
  std::optional<ColmapModel> model;
  CurvePoseRecord record;
};

// "50 views, 0.507 to 0.135 px, shifts up to 2.26 px": what was done, in a few
// words. The errors are medians, of samples of curves that were held out; of
// points if no sample was.
std::string CurvePosesText(const CurvePoseRecord& record);

// Why poses that were found stay unused, as a sentence; "": none was found, or
// they are used.
std::string CurvePosesRefusal(const CurvePoseRecord& record);

// Gives `scene` the poses and cameras that were found for it.
void MoveViews(const CurvePoses& found, Scene* scene);

// What RefinePosesWithCurves() has made of `scene` for `model`. The scene is
// that of the model, without the views whose images are missing.
CurvePoseRefinement ModelWithCurvePoses(const ColmapModel& model,
                                        const Scene& scene,
                                        CurvePoses refined);

}  // namespace curvix
