// SPDX-License-Identifier: BSD-3-Clause
#include "model/check_input.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "base/count_text.h"

namespace curvix {
namespace {

// Of an edge from the corner of its image. No camera sees further, and indices
// of places stay small numbers.
constexpr double kFarthestPx = 1e6;

Status CheckView(const Scene& scene, const View& view) {
  if (view.camera_idx < 0 ||
      static_cast<std::size_t>(view.camera_idx) >= scene.cameras.size()) {
    return Status::InvalidArgument(
        "View " + view.name + " has camera index " +
        std::to_string(view.camera_idx) + ", but there " +
        OneOrMore(scene.cameras.size(), "is ", "are ") +
        Plural(scene.cameras.size(), "camera"));
  }
  const Rigid3& pose = view.cam_from_world;
  if (!pose.translation.allFinite() || !pose.rotation.coeffs().allFinite() ||
      std::abs(pose.rotation.norm() - 1) > 1e-6) {
    return Status::InvalidArgument(
        "The pose of view " + view.name +
        " is no rigid motion: a number is not finite or the "
        "quaternion is not of unit length");
  }
  return {};
}

bool IsIn(const std::optional<std::int32_t>& idx, std::size_t size) {
  return !idx || (*idx >= 0 && static_cast<std::size_t>(*idx) < size);
}

bool IsSound(const ScenePoint& point, std::size_t num_views) {
  return point.position.allFinite() &&
         (point.pixels.empty() ||
          point.pixels.size() == point.view_idxs.size()) &&
         std::ranges::all_of(point.view_idxs,
                             [&](int idx) { return IsIn(idx, num_views); });
}

bool IsSound(const Edge2d& edge) {
  const auto is_finite = [](auto number) {
    return std::isfinite(static_cast<float>(number));
  };
  return edge.position.allFinite() &&
         edge.position.cwiseAbs().maxCoeff() <= kFarthestPx &&
         is_finite(edge.angle) && is_finite(edge.sharpness) &&
         is_finite(edge.strength) && edge.strength >= 0 &&
         is_finite(edge.level) && is_finite(edge.fine_px) &&
         !std::isnan(static_cast<float>(edge.crowding));
}

bool IsSound(const EdgeMap& map) {
  if (map.neighbors.size() != map.edges.size()) return false;
  if (!(map.spacing_px > 0) || !std::isfinite(map.spacing_px)) return false;
  if (!std::isfinite(map.noise) || !std::isfinite(map.fine_variance_gain_px2)) {
    return false;
  }
  for (const Edge2d& edge : map.edges) {
    if (!IsSound(edge)) return false;
  }
  for (const EdgeNeighbors& neighbors : map.neighbors) {
    if (!IsIn(neighbors.previous, map.edges.size()) ||
        !IsIn(neighbors.next, map.edges.size())) {
      return false;
    }
  }
  return true;
}

bool IsSound(const Edge3d& edge, const std::vector<EdgeMap>& edge_maps) {
  int last_view_idx = -1;
  for (const EdgeRef& ref : edge.support) {
    if (ref.view_idx <= last_view_idx || ref.edge_idx < 0) return false;
    last_view_idx = ref.view_idx;
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    if (view_idx >= edge_maps.size() ||
        static_cast<std::size_t>(ref.edge_idx) >=
            edge_maps[view_idx].edges.size()) {
      return false;
    }
  }
  constexpr double kRounding = 1e-6;
  return edge.position.allFinite() && edge.tangent.allFinite() &&
         std::abs(edge.tangent.norm() - 1) < kRounding &&
         std::isfinite(edge.sigma) && edge.sigma >= 0 &&
         std::isfinite(edge.evidence);
}

}  // namespace

Status CheckScene(const Scene& scene) {
  if (scene.views.size() < 3) {
    return Status::InvalidArgument(
        "Curves need at least three views, and there are " +
        std::to_string(scene.views.size()));
  }
  for (const Camera& camera : scene.cameras) {
    CURVIX_RETURN_IF_ERROR(Validate(camera));
  }
  for (const View& view : scene.views) {
    CURVIX_RETURN_IF_ERROR(CheckView(scene, view));
  }
  for (const ScenePoint& point : scene.points) {
    if (IsSound(point, scene.views.size())) continue;
    return Status::InvalidArgument(
        "A sparse point is not sound: a finite position, views of the scene "
        "and, if it has pixels, one per view are needed");
  }
  return {};
}

Status CheckEdgeMaps(const Scene& scene,
                     const std::vector<EdgeMap>& edge_maps) {
  if (edge_maps.size() != scene.views.size()) {
    return Status::InvalidArgument(
        "There " + OneOrMore(edge_maps.size(), "is ", "are ") +
        Plural(edge_maps.size(), "edge map") + " for " +
        Plural(scene.views.size(), "view") + "; one per view is needed");
  }
  for (std::size_t i = 0; i < edge_maps.size(); ++i) {
    if (IsSound(edge_maps[i])) continue;
    return Status::InvalidArgument(
        "The edges of view " + scene.views[i].name +
        " are not sound: one entry of neighbors per edge, "
        "neighbors among the edges, finite numbers, and "
        "positions within a million pixels are needed");
  }
  return {};
}

Status CheckEdgeSketch(const std::vector<EdgeMap>& edge_maps,
                       const EdgeSketch& sketch) {
  const bool is_sound =
      sketch.edge_sigma_px > 0 && std::isfinite(sketch.edge_sigma_px) &&
      std::ranges::all_of(sketch.edges, [&](const Edge3d& edge) {
        return IsSound(edge, edge_maps);
      });
  if (is_sound) return {};
  return Status::InvalidArgument(
      "The 3D edges are not sound: finite numbers, a positive edge_sigma_px "
      "and, in the order of views, "
      "at most one 2D edge per view are needed, and these among the edges");
}

}  // namespace curvix
