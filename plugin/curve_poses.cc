// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "plugin/curve_poses.h"

#include <cstdio>
#include <map>
#include <utility>

#include "plugin/bundle.h"
#include "plugin/similarity.h"
#include "plugin/text.h"

namespace curvix {
namespace {

// Brings the unit of the world back to that of `scene`; false if the poses do
// not resemble its.
bool RestoreUnit(const Scene& scene, CurvePoseRecord* record) {
  std::vector<Rigid3> input;
  for (const View& view : scene.views) input.push_back(view.cam_from_world);
  std::vector<Rigid3>& poses = record->poses.cam_from_world;
  const std::optional<Similarity3> aligned = AlignPoses(poses, input);
  if (!aligned) return false;
  record->scale_removed = 1 / aligned->scale;
  // Place and direction are right already, as the pictures tell them.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Rigid3& pose : poses) center += pose.Inverse().translation;
  center /= static_cast<double>(poses.size());
  Similarity3 back;
  back.scale = aligned->scale;
  back.translation = (1 - back.scale) * center;
  for (Rigid3& pose : poses) pose = MovePose(back, pose);
  return true;
}

// `model` with the poses of the views of `scene`, and points that fit them.
ColmapModel WithPoses(ColmapModel model,
                      const Scene& scene,
                      const std::vector<Rigid3>& cam_from_world) {
  std::map<std::uint32_t, Rigid3> poses;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    poses[scene.views[i].image_id] = cam_from_world[i];
  }
  for (ColmapImage& image : model.images) {
    const auto found = poses.find(image.image_id);
    if (found != poses.end()) image.cam_from_world = found->second;
  }
  Bundle bundle = BundleFromModel(model);
  FitPoints(&bundle);
  return ModelWithBundle(std::move(model), bundle);
}

// What the points say; nothing if there are too few.
std::optional<PoseJudgement> JudgeByPoints(const ColmapModel& before,
                                           const ColmapModel& after) {
  Bundle old_bundle = BundleFromModel(before);
  Bundle new_bundle = old_bundle;
  const std::vector<BundlePoint> check_points = TakeCheckPoints(&old_bundle);
  if (check_points.size() < kMinCheckPoints) return std::nullopt;
  for (BundleView& view : new_bundle.views) {
    view.cam_from_world = after.images[view.image_idx].cam_from_world;
  }
  return JudgePoses(old_bundle, new_bundle, check_points);
}

void Refuse(const std::string& reason, CurvePoses* poses) {
  poses->accepted = false;
  poses->reason = reason;
}

std::string Errors(double before_px, double after_px) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.3f to %.3f px", before_px, after_px);
  return text;
}

}  // namespace

std::string CurvePosesText(const CurvePoseRecord& record) {
  const CurvePoses& poses = record.poses;
  if (poses.num_views_moved == 0) {
    return poses.num_check_observations == 0 ? "kept" : "kept, " + poses.reason;
  }
  char shifts[64];
  std::snprintf(
      shifts, sizeof(shifts), ", shifts up to %.2f px", poses.max_shift_px);
  return GroupDigits(static_cast<std::int64_t>(poses.num_views_moved)) +
         " views, " + Errors(poses.before.mean_px, poses.after.mean_px) +
         shifts + (poses.accepted ? "" : ", refused");
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
  if (!RestoreUnit(scene, &result.record)) {
    Refuse("its cameras do not resemble the input", &poses);
    return result;
  }
  ColmapModel with_poses = WithPoses(model, scene, poses.cam_from_world);
  result.record.points = JudgeByPoints(model, with_poses);
  if (const auto& points = result.record.points;
      points &&
      !(points->after.mean_px <= points->before.mean_px * (1 + kMinGain))) {
    Refuse("the points fit worse: their mean error went from " +
               Errors(points->before.mean_px, points->after.mean_px),
           &poses);
    return result;
  }
  result.model = std::move(with_poses);
  return result;
}

}  // namespace curvix
