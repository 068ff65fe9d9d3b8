// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/holdout.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/count_text.h"
#include "model/check_input.h"

namespace curvix {
namespace {

// The views used, with indices of their own.
struct Subset {
  Scene scene;
  std::vector<EdgeMap> edge_maps;
  std::vector<std::int32_t> view_idxs;  // in the whole scene
};

Subset UsedViews(const Scene& scene,
                 const std::vector<EdgeMap>& edge_maps,
                 const std::vector<int>& held_out) {
  Subset used;
  used.scene.cameras = scene.cameras;
  std::vector<int> new_idxs(scene.views.size(), -1);
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    if (std::ranges::binary_search(held_out, static_cast<int>(i))) {
      continue;
    }
    new_idxs[i] = static_cast<int>(used.view_idxs.size());
    used.view_idxs.push_back(static_cast<std::int32_t>(i));
    used.scene.views.push_back(scene.views[i]);
    used.edge_maps.push_back(edge_maps[i]);
  }
  for (const ScenePoint& point : scene.points) {
    ScenePoint& left = used.scene.points.emplace_back();
    left.position = point.position;
    for (std::size_t i = 0; i < point.view_idxs.size(); ++i) {
      const int new_idx =
          new_idxs[static_cast<std::size_t>(point.view_idxs[i])];
      if (new_idx < 0) continue;
      left.view_idxs.push_back(new_idx);
      if (!point.pixels.empty()) left.pixels.push_back(point.pixels[i]);
    }
  }
  return used;
}

void RestoreViewIdxs(const std::vector<std::int32_t>& view_idxs,
                     std::vector<EdgeRef>* support) {
  for (EdgeRef& ref : *support) {
    ref.view_idx = view_idxs[static_cast<std::size_t>(ref.view_idx)];
  }
}

}  // namespace

Result<std::vector<int>> ViewsHeldOut(std::size_t num_views, int every) {
  if (every < 2) {
    return Status::InvalidArgument(
        "At least every second view must be left in");
  }
  std::vector<int> view_idxs;
  const int n = static_cast<int>(num_views);
  for (int i = every / 2; i < n; i += every) view_idxs.push_back(i);
  if (view_idxs.empty()) {
    return Status::InvalidArgument("None of " + Plural(num_views, "view") +
                                   " is held out if it is one of " +
                                   std::to_string(every) + "; hold out more");
  }
  return view_idxs;
}

Result<Holdout> ReconstructWithHoldout(const Scene& scene,
                                       const std::vector<EdgeMap>& edge_maps,
                                       const Options& options,
                                       int every,
                                       const Progress& progress) {
  CURVIX_RETURN_IF_ERROR(CheckScene(scene));
  CURVIX_RETURN_IF_ERROR(CheckEdgeMaps(scene, edge_maps));
  Holdout holdout;
  CURVIX_ASSIGN_OR_RETURN(holdout.view_idxs,
                          ViewsHeldOut(scene.views.size(), every));
  const Subset used = UsedViews(scene, edge_maps, holdout.view_idxs);
  CURVIX_ASSIGN_OR_RETURN(
      holdout.reconstruction,
      ReconstructCurves(used.scene, used.edge_maps, options, progress));
  for (Curve& curve : holdout.reconstruction.curves.curves) {
    for (CurveSample& sample : curve.samples) {
      RestoreViewIdxs(used.view_idxs, &sample.support);
    }
  }
  for (Edge3d& edge : holdout.reconstruction.edges) {
    RestoreViewIdxs(used.view_idxs, &edge.support);
  }
  return holdout;
}

}  // namespace curvix
