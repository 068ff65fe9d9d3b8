// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "pipeline/judge_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "base/median.h"
#include "base/parallel.h"

namespace curvix {
namespace {

constexpr int kPartsPerCheckPart = 5;
constexpr double kCubesPerDistance = 10;
// Refused: fewer places held out; a view with fewer observations.
constexpr std::size_t kMinCheckPlaces = 20;
constexpr std::size_t kMinObservationsPerView = 8;
// Of the mean error; the median hardly falls where a few views are wrong. Of
// right poses it falls by up to a tenth if some 25 views look, where
// borders of shading are most of what is seen.
constexpr double kMinGain = 0.15;
constexpr double kMaxErrorPx = 1;

using Error = std::optional<double>;  // nothing: no edge near

// The errors of a place fitted to the poses of `edges`, in its views to ask.
std::vector<Error> Errors(const CurvePlace& start, const PosedEdges& edges) {
  const std::vector<std::size_t> views = edges.ViewsToAsk(start);
  CurvePlace place = start;
  struct Pass {
    double gate_px, sigma_px;
  };
  for (const Pass& pass : {Pass{2, 0.5}, Pass{1, 0.25}, Pass{1, 0.15}}) {
    const std::vector<double> gates(edges.views().size(), pass.gate_px);
    place.support = edges.FindEdges(place.rim, views, gates);
    place.rim = edges.Adjusted(place, pass.sigma_px);
  }
  const std::vector<double> gates(edges.views().size(), kMaxErrorPx);
  std::vector<Error> errors(views.size());
  for (const EdgeRef& ref : edges.FindEdges(place.rim, views, gates)) {
    const auto found = std::lower_bound(
        views.begin(), views.end(), static_cast<std::size_t>(ref.view_idx));
    errors[static_cast<std::size_t>(found - views.begin())] =
        std::min(kMaxErrorPx, edges.Distance(place.rim, ref));
  }
  return errors;
}

std::vector<std::vector<Error>> AllErrors(const std::vector<CurvePlace>& places,
                                          int num_threads,
                                          const PosedEdges& edges) {
  std::vector<std::vector<Error>> errors(places.size());
  ParallelFor(places.size(), num_threads, [&](std::size_t i) {
    errors[i] = Errors(places[i], edges);
  });
  return errors;
}

// Errors of one place in one view before and after, where an edge is near
// before or after.
struct Pair {
  std::size_t view_idx = 0;
  double before = 0;
  double after = 0;
};

std::vector<Pair> PairUp(const std::vector<CurvePlace>& places,
                         const std::vector<std::vector<Error>>& before,
                         const std::vector<std::vector<Error>>& after,
                         const PosedEdges& edges) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::vector<std::size_t> views = edges.ViewsToAsk(places[i]);
    for (std::size_t k = 0; k < views.size(); ++k) {
      if (!before[i][k] && !after[i][k]) continue;
      pairs.push_back({views[k],
                       before[i][k].value_or(kMaxErrorPx),
                       after[i][k].value_or(kMaxErrorPx)});
    }
  }
  return pairs;
}

// Which views are better after.
std::vector<bool> BetterViews(const std::vector<Pair>& pairs,
                              std::size_t num_views) {
  std::vector<double> gains(num_views, 0);
  std::vector<std::size_t> counts(num_views, 0);
  for (const Pair& pair : pairs) {
    gains[pair.view_idx] += pair.before - pair.after;
    ++counts[pair.view_idx];
  }
  std::vector<bool> better(num_views);
  for (std::size_t i = 0; i < num_views; ++i) {
    better[i] = counts[i] >= kMinObservationsPerView && gains[i] > 0;
  }
  return better;
}

void SummarizeErrors(const std::vector<Pair>& pairs, CurvePoses* result) {
  std::vector<double> before, after;
  for (const Pair& pair : pairs) {
    before.push_back(pair.before);
    after.push_back(pair.after);
    result->before.mean_px += pair.before / static_cast<double>(pairs.size());
    result->after.mean_px += pair.after / static_cast<double>(pairs.size());
  }
  result->num_check_observations = pairs.size();
  result->before.median_px = MedianOr(0, std::move(before));
  result->after.median_px = MedianOr(0, std::move(after));
}

void MeasureShifts(const std::vector<CurvePlace>& places,
                   const PosedEdges& edges,
                   CurvePoses* result) {
  std::vector<double> medians;
  for (std::vector<double>& shifts : edges.ShiftsByView(places)) {
    medians.push_back(MedianOr(0, std::move(shifts)));
  }
  const auto largest = std::max_element(medians.begin(), medians.end());
  result->max_shift_px = *largest;
  result->max_shift_view_idx =
      static_cast<std::size_t>(largest - medians.begin());
  result->median_shift_px = MedianOr(0, std::move(medians));
}

void Decide(CurvePoses* result) {
  char fall[128];
  std::snprintf(fall,
                sizeof(fall),
                "the mean distance from edges that were held out went from "
                "%.3f to %.3f px",
                result->before.mean_px,
                result->after.mean_px);
  if (result->num_check_samples < kMinCheckPlaces) {
    result->reason = "too few places on curves are left to judge by";
  } else if (!(result->after.mean_px <
               result->before.mean_px * (1 - kMinGain))) {
    result->reason =
        std::string("the gain is too small to be sure of: ") + fall;
  } else {
    result->accepted = true;
    result->reason = fall;
  }
}

}  // namespace

std::vector<CurvePlace> TakeCheckPlaces(std::vector<CurvePlace>* places) {
  Eigen::Vector3d center;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const CurvePlace& place : *places) {
      values.push_back(MiddleOf(place.rim)[axis]);
    }
    center[axis] = MedianOr(0, std::move(values));
  }
  std::vector<double> distances;
  for (const CurvePlace& place : *places) {
    distances.push_back((MiddleOf(place.rim) - center).norm());
  }
  const double distance = MedianOr(0, std::move(distances));
  const double cube = distance > 0 ? distance / kCubesPerDistance : 1;
  std::vector<CurvePlace> kept, taken;
  for (CurvePlace& place : *places) {
    const Eigen::Vector3d cell =
        ((MiddleOf(place.rim) - center) / cube).array().floor();
    const double sum = cell.x() + 2 * cell.y() + 3 * cell.z();
    const double part =
        sum - kPartsPerCheckPart * std::floor(sum / kPartsPerCheckPart);
    (part == 0 ? taken : kept).push_back(std::move(place));
  }
  *places = std::move(kept);
  return taken;
}

CurvePoses JudgeMotions(const std::vector<CurvePlace>& check_places,
                        const Scene& scene,
                        int num_threads,
                        PosedEdges* edges) {
  const std::size_t num_views = scene.views.size();
  CurvePoses result;
  result.num_check_samples = check_places.size();
  std::vector<Rigid3> motions = edges->motions();
  edges->SetMotions(std::vector<Rigid3>(num_views));
  const auto before = AllErrors(check_places, num_threads, *edges);
  edges->SetMotions(motions);
  const auto moved = AllErrors(check_places, num_threads, *edges);
  const std::vector<bool> better =
      BetterViews(PairUp(check_places, before, moved, *edges), num_views);
  for (std::size_t i = 0; i < num_views; ++i) {
    if (!better[i]) motions[i] = Rigid3();
    if (better[i]) ++result.num_views_moved;
  }
  edges->SetMotions(motions);
  const auto after = AllErrors(check_places, num_threads, *edges);
  SummarizeErrors(PairUp(check_places, before, after, *edges), &result);
  MeasureShifts(check_places, *edges, &result);
  Decide(&result);
  for (std::size_t i = 0; i < num_views; ++i) {
    const Rigid3& pose = scene.views[i].cam_from_world;
    result.cam_from_world.push_back(result.accepted ? motions[i] * pose : pose);
  }
  return result;
}

}  // namespace curvix
