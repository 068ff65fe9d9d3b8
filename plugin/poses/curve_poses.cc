// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/curve_poses.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/count_text.h"
#include "base/median.h"
#include "base/text_fields.h"
#include "geometry/lens.h"
#include "plugin/poses/adjustable_scene.h"

namespace curvix {
namespace {

// The cameras of `before` that differ now, once more with new ids, for the
// images that are not views of `scene`: their poses were made for them.
void KeepCamerasOfOthers(const std::vector<ColmapCamera>& before,
                         const Scene& scene,
                         ColmapModel* model) {
  std::set<std::uint32_t> moved_ids;
  for (const View& view : scene.views) moved_ids.insert(view.image_id);
  std::uint32_t last_id = 0;
  for (const ColmapCamera& camera : before) {
    last_id = std::max(last_id, camera.camera_id);
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (model->cameras[i].camera == before[i].camera) continue;
    bool is_used = false;
    for (ColmapImage& image : model->images) {
      if (image.camera_id != before[i].camera_id ||
          moved_ids.contains(image.image_id)) {
        continue;
      }
      image.camera_id = last_id + 1;
      is_used = true;
    }
    if (is_used) model->cameras.push_back({++last_id, before[i].camera});
  }
}

// `model` with the poses of the views of `scene` and its cameras, and points
// that fit them. Other images stay as they are.
ColmapModel WithPoses(const ColmapModel& model,
                      Scene scene,
                      const CurvePoses& refined) {
  scene.points.clear();
  MoveViews(refined, &scene);
  ColmapModel moved = ModelWithScene(model, scene);
  KeepCamerasOfOthers(model.cameras, scene, &moved);
  Scene adjusted = AdjustableScene(moved);
  FitPoints(&adjusted);
  return ModelWithScene(std::move(moved), adjusted);
}

// Of the held-out samples of curves; of the held-out points if there are none.
std::string ErrorsText(const CurvePoses& poses) {
  const bool has_samples = poses.num_check_observations > 0;
  const ErrorsOfViews& before =
      has_samples ? poses.before : poses.points_before;
  const ErrorsOfViews& after = has_samples ? poses.after : poses.points_after;
  return FixedText(before.median_px, 3) + " to " +
         FixedText(after.median_px, 3) + " px";
}

std::string CamerasText(const std::vector<CameraChange>& cameras) {
  if (cameras.empty()) return "";
  std::vector<double> shifts_px;
  for (const CameraChange& camera : cameras) {
    shifts_px.push_back(camera.median_shift_px);
  }
  return ", " + Plural(cameras.size(), "camera") + " (" +
         std::string(ModelName(cameras.front().to.model)) + ", " +
         FixedText(MedianOrNan(std::move(shifts_px)), 2) + " px)";
}

}  // namespace

std::string CurvePosesText(const CurvePoseRecord& record) {
  const CurvePoses& poses = record.poses;
  if (poses.num_views_moved == 0) {
    const bool is_judged =
        poses.num_check_observations + poses.num_check_points > 0;
    return is_judged ? "kept, " + poses.reason : "kept";
  }
  return Plural(poses.num_views_moved, "view") + ", " + ErrorsText(poses) +
         CamerasText(record.cameras) + ", shifts up to " +
         FixedText(poses.max_shift_px, 2) + " px" +
         (poses.accepted ? "" : ", refused");
}

std::string CurvePosesRefusal(const CurvePoseRecord& record) {
  const CurvePoses& poses = record.poses;
  if (poses.accepted || poses.num_views_moved == 0) return "";
  return "Refinement with curves is refused: " + poses.reason + ".";
}

void MoveViews(const CurvePoses& found, Scene* scene) {
  scene->cameras = found.cameras;
  for (std::size_t i = 0; i < scene->views.size(); ++i) {
    scene->views[i].cam_from_world = found.cam_from_world[i];
  }
}

CurvePoseRefinement ModelWithCurvePoses(const ColmapModel& model,
                                        const Scene& scene,
                                        CurvePoses refined) {
  CurvePoseRefinement result;
  result.record.poses = std::move(refined);
  CurvePoses& poses = result.record.poses;
  result.record.largest_shift_image =
      scene.views[poses.max_shift_view_idx].name;
  if (!poses.accepted) return result;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    if (poses.cameras[i] == scene.cameras[i]) continue;
    result.record.cameras.push_back(
        {model.cameras[i].camera_id,
         scene.cameras[i],
         poses.cameras[i],
         ShiftOfImage(scene.cameras[i], poses.cameras[i])});
  }
  result.model = WithPoses(model, scene, poses);
  return result;
}

}  // namespace curvix
