// SPDX-License-Identifier: BSD-3-Clause
// Acceptance of refined poses. Bundle adjustment
// always lowers the errors that it sees, on badly spread points by bending the
// scene. So some points are held out, and shifts must be explained by their
// errors.
#pragma once

#include <curvix/refine_poses.h>
#include <curvix/scene.h>
#include <cstddef>
#include <string>
#include <vector>

namespace curvix {

// Refused: fewer points held out than this.
inline constexpr std::size_t kMinCheckPoints = 8;
// One point in so many is held out: the poses lose a twentieth of their
// precision by it.
inline constexpr std::size_t kPointsPerCheckPoint = 10;
// Errors count at most this much in means.
inline constexpr double kMaxErrorPx = 10;
// Refused: the mean error falls by a smaller share than this.
inline constexpr double kMinGain = 0.01;
// Refused: what a view sees shifts, or its camera moves, by more.
inline constexpr double kMaxShiftPx = 20;
inline constexpr double kMaxMove = 0.05;  // of the median distance to points
// Refused: the median shift of the views is more than so many times the error
// that it explains. Wrong poses shift images by about as much as they explain;
// a larger shift is one that the points hardly observe.
inline constexpr double kMaxShiftPerExplained = 3;

struct PoseJudgement {
  bool accepted = false;
  std::string reason;  // why, or why not: part of a sentence, no full stop
  std::size_t num_check_points = 0;
  std::size_t num_check_observations = 0;
  ErrorsOfViews before;  // of the observations held out; means of errors cut
  ErrorsOfViews after;   // at kMaxErrorPx
  // Root of the fall of the mean square error.
  double explained_px = 0;
  // How far a view's points, at their places before, shift in its image when
  // its pose changes: the median over the view's points; of all views
  // the median and the largest, and the index of that view.
  double median_shift_px = 0;
  double max_shift_px = 0;
  std::size_t max_shift_view_idx = 0;
  double max_turn_deg = 0;
  double max_move = 0;  // of a centre; share of the median distance from
                        // cameras to the points that they see
};

// The points of `scene` that are held out: every kPointsPerCheckPoint-th. They
// are removed from it.
std::vector<ScenePoint> TakeCheckPoints(Scene* scene);

// Whether the views of `poses` see `check_points`, fitted anew, where the poses
// put them, so that there is nothing to gain. All of their pixels are known.
bool PosesFit(const Scene& poses, const std::vector<ScenePoint>& check_points);

// Compares `after`, aligned to `before`, with it: two adjustable scenes of the
// same views. The errors are those of `check_points`, each fitted anew under
// either poses, so that neither side has seen them.
PoseJudgement JudgePoses(const Scene& before,
                         const Scene& after,
                         const std::vector<ScenePoint>& check_points);

}  // namespace curvix
