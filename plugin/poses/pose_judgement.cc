// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/pose_judgement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/angles.h"
#include "base/check.h"
#include "base/infinity.h"
#include "base/median.h"
#include "base/text_fields.h"
#include "colmap/inconsistent_points.h"
#include "geometry/fit_point.h"
#include "plugin/poses/adjustable_scene.h"

namespace curvix {
namespace {

struct CheckErrors {
  ErrorsOfViews summary;
  double mean_square = 0;
  std::size_t count = 0;
};

CheckErrors MeasureErrors(const Scene& poses,
                          const std::vector<ScenePoint>& check_points) {
  std::vector<double> errors;
  for (ScenePoint point : check_points) {
    point.position = FitPoint(poses, point);
    for (const double error : ReprojectionErrors(poses, point)) {
      errors.push_back(std::min(error, kMaxErrorPx));
    }
  }
  CheckErrors result;
  result.count = errors.size();
  for (const double error : errors) {
    result.summary.mean_px += error / static_cast<double>(errors.size());
    result.mean_square += error * error / static_cast<double>(errors.size());
  }
  result.summary.median_px = MedianOrNan(std::move(errors));
  return result;
}

// The median shift of each view. A change of its camera does not count: points
// that are all nearer or further away may make up for that.
std::vector<double> Shifts(const Scene& before, const Scene& after) {
  std::vector<std::vector<double>> shifts(before.views.size());
  for (const ScenePoint& point : before.points) {
    for (const int view_idx : point.view_idxs) {
      const auto i = static_cast<std::size_t>(view_idx);
      const View& view = before.views[i];
      const Camera& camera = CameraOf(before, view);
      const auto from = Project(camera, view.cam_from_world, point.position);
      const auto to =
          Project(camera, after.views[i].cam_from_world, point.position);
      shifts[i].push_back(from && to ? (*to - *from).norm() : kInfinity);
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& values : shifts) {
    medians.push_back(values.empty() ? 0 : MedianOrNan(std::move(values)));
  }
  return medians;
}

double MedianDistance(const Scene& scene) {
  std::vector<double> distances;
  for (const ScenePoint& point : scene.points) {
    for (const int view_idx : point.view_idxs) {
      const View& view = scene.views[static_cast<std::size_t>(view_idx)];
      distances.push_back((view.cam_from_world * point.position).norm());
    }
  }
  return MedianOrNan(std::move(distances));
}

void MeasureMoves(const Scene& before,
                  const Scene& after,
                  PoseJudgement* judgement) {
  const double distance = MedianDistance(before);
  for (std::size_t i = 0; i < before.views.size(); ++i) {
    const Rigid3& from = before.views[i].cam_from_world;
    const Rigid3& to = after.views[i].cam_from_world;
    const double move =
        (to.Inverse().translation - from.Inverse().translation).norm();
    const double turn = from.rotation.angularDistance(to.rotation);
    judgement->max_move = std::max(judgement->max_move, move / distance);
    judgement->max_turn_deg = std::max(judgement->max_turn_deg, RadToDeg(turn));
  }
  const std::vector<double> shifts = Shifts(before, after);
  const auto largest = std::ranges::max_element(shifts);
  judgement->max_shift_px = *largest;
  judgement->max_shift_view_idx =
      static_cast<std::size_t>(largest - shifts.begin());
  judgement->median_shift_px = MedianOrNan(shifts);
}

// Why the poses are refused; empty if they are not. NaN is refused.
std::string Objection(const PoseJudgement& j) {
  if (j.num_check_points < kMinCheckPoints) {
    return "too few points are left to judge by";
  }
  const std::string mean =
      FixedText(j.before.mean_px, 3) + " to " + FixedText(j.after.mean_px, 3);
  const std::string fall =
      "the mean error of points that were held out went from " + mean + " px";
  if (!(j.after.mean_px < j.before.mean_px * (1 - kMinGain))) {
    return "there is nothing to gain: " + fall;
  }
  if (!(j.after.median_px < j.before.median_px)) {
    return "the median error of points that were held out does not fall (" +
           FixedText(j.before.median_px, 3) + " to " +
           FixedText(j.after.median_px, 3) + " px), though the mean does (" +
           mean + " px)";
  }
  if (!(j.max_move <= kMaxMove)) {
    return "a camera moved by " + FixedText(100 * j.max_move, 1) +
           " % of its distance to the points, more than poses are off by";
  }
  if (!(j.max_shift_px <= kMaxShiftPx)) {
    return "a view shifted by " + FixedText(j.max_shift_px, 1) +
           " px, more than poses are off by";
  }
  if (!(j.median_shift_px <= kMaxShiftPerExplained * j.explained_px)) {
    return "the views shifted by " + FixedText(j.median_shift_px, 2) +
           " px, which the points hardly tell: " + fall;
  }
  return "";
}

}  // namespace

std::vector<ScenePoint> TakeCheckPoints(Scene* scene) {
  std::vector<ScenePoint> kept;
  std::vector<ScenePoint> taken;
  for (std::size_t i = 0; i < scene->points.size(); ++i) {
    const bool take = i % kPointsPerCheckPoint == kPointsPerCheckPoint / 2;
    (take ? taken : kept).push_back(std::move(scene->points[i]));
  }
  scene->points = std::move(kept);
  return taken;
}

bool PosesFit(const Scene& poses, const std::vector<ScenePoint>& check_points) {
  std::vector<std::vector<double>> by_view(poses.views.size());
  for (ScenePoint point : check_points) {
    point.position = FitPoint(poses, point);
    const std::vector<double> errors = ReprojectionErrors(poses, point);
    CURVIX_CHECK(errors.size() == point.view_idxs.size(), "unknown pixels");
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const auto view_idx = static_cast<std::size_t>(point.view_idxs[i]);
      by_view[view_idx].push_back(errors[i]);
    }
  }
  return PointsFit(std::move(by_view));
}

PoseJudgement JudgePoses(const Scene& before,
                         const Scene& after,
                         const std::vector<ScenePoint>& check_points) {
  PoseJudgement judgement;
  judgement.num_check_points = check_points.size();
  const CheckErrors old_errors = MeasureErrors(before, check_points);
  const CheckErrors new_errors = MeasureErrors(after, check_points);
  judgement.num_check_observations = old_errors.count;
  judgement.before = old_errors.summary;
  judgement.after = new_errors.summary;
  judgement.explained_px =
      std::sqrt(std::max(0.0, old_errors.mean_square - new_errors.mean_square));
  MeasureMoves(before, after, &judgement);
  judgement.reason = Objection(judgement);
  judgement.accepted = judgement.reason.empty();
  if (judgement.accepted) {
    judgement.reason = "the errors fall on points that were held out, too";
  }
  return judgement;
}

}  // namespace curvix
