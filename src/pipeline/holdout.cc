// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Reconstructs from some views, looks at the others.
#include <curvix/holdout.h>

#include <algorithm>
#include <string>
#include <utility>

#include "geometry/posed_views.h"
#include "pipeline/check_input.h"
#include "validation/holdout_agreement.h"

namespace curvix {
namespace {

// The views used, with indices of their own.
struct Subset {
  Scene scene;
  std::vector<EdgeMap> edge_maps;
  std::vector<std::int32_t> view_idxs;  // in the whole scene
};

std::vector<bool> HeldOut(std::size_t num_views, int every) {
  std::vector<bool> is_held_out(num_views);
  const auto step = static_cast<std::size_t>(every);
  for (std::size_t i = step - 1; i < num_views; i += step) {
    is_held_out[i] = true;
  }
  return is_held_out;
}

Subset UsedViews(const Scene& scene,
                 const std::vector<EdgeMap>& edge_maps,
                 const std::vector<bool>& is_held_out) {
  Subset used;
  used.scene.cameras = scene.cameras;
  std::vector<int> new_idxs(scene.views.size(), -1);
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    if (is_held_out[i]) continue;
    new_idxs[i] = static_cast<int>(used.view_idxs.size());
    used.view_idxs.push_back(static_cast<std::int32_t>(i));
    used.scene.views.push_back(scene.views[i]);
    used.edge_maps.push_back(edge_maps[i]);
  }
  for (ScenePoint point : scene.points) {
    std::vector<int> view_idxs;
    for (const int view_idx : point.view_idxs) {
      const int new_idx = new_idxs[static_cast<std::size_t>(view_idx)];
      if (new_idx >= 0) view_idxs.push_back(new_idx);
    }
    point.view_idxs = std::move(view_idxs);
    used.scene.points.push_back(std::move(point));
  }
  return used;
}

void RestoreViewIdxs(const std::vector<std::int32_t>& view_idxs,
                     std::vector<EdgeRef>* support) {
  for (EdgeRef& ref : *support) {
    ref.view_idx = view_idxs[static_cast<std::size_t>(ref.view_idx)];
  }
}

Status CheckOptions(const HoldoutOptions& options, std::size_t num_views) {
  if (options.every < 2 || !(options.max_distance_px > 0) ||
      !(options.max_angle_deg > 0) || !(options.shift_px > 0)) {
    return {StatusCode::kInvalidArgument,
            "at least every second view must be left in, and distances and "
            "angles be positive"};
  }
  if (num_views < static_cast<std::size_t>(options.every)) {
    return {StatusCode::kInvalidArgument,
            "none of " + std::to_string(num_views) +
                " views is held out if it is every " +
                std::to_string(options.every) + "th; hold out more"};
  }
  return {};
}

}  // namespace

Result<Holdout> EvaluateHoldout(const Scene& scene,
                                const std::vector<EdgeMap>& edge_maps,
                                const Options& options,
                                const HoldoutOptions& holdout_options,
                                const Progress& progress) {
  if (Status status = CheckScene(scene); !status.ok()) return status;
  if (Status status = CheckEdgeMaps(scene, edge_maps); !status.ok()) {
    return status;
  }
  Status valid = CheckOptions(holdout_options, scene.views.size());
  if (!valid.ok()) return valid;

  const std::vector<bool> is_held_out =
      HeldOut(scene.views.size(), holdout_options.every);
  const Subset used = UsedViews(scene, edge_maps, is_held_out);
  Result<Reconstruction> reconstruction =
      ReconstructCurves(used.scene, used.edge_maps, options, progress);
  if (!reconstruction.ok()) return reconstruction.status();

  Holdout holdout;
  holdout.num_held_out = static_cast<int>(
      std::count(is_held_out.begin(), is_held_out.end(), true));
  holdout.reconstruction = *std::move(reconstruction);
  for (Curve& curve : holdout.reconstruction.curves.curves) {
    for (CurveSample& sample : curve.samples) {
      RestoreViewIdxs(used.view_idxs, &sample.support);
    }
  }
  for (Edge3d& edge : holdout.reconstruction.edges) {
    RestoreViewIdxs(used.view_idxs, &edge.support);
  }
  const HoldoutAgreements agreements =
      MeasureAgreement(holdout.reconstruction.curves.curves,
                       MakePosedViews(scene),
                       edge_maps,
                       is_held_out,
                       holdout_options,
                       options.runtime.num_threads);
  holdout.all = agreements.all;
  holdout.expected = agreements.expected;
  return holdout;
}

}  // namespace curvix
