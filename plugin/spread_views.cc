// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/spread_views.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace curvix {
namespace {

struct Place {
  Eigen::Vector3d center;
  Eigen::Vector3d direction;
};

std::vector<Place> PlacesOf(const Scene& scene) {
  std::vector<Place> places;
  double largest = 0;
  for (const View& view : scene.views) {
    const Rigid3 world_from_cam = view.cam_from_world.Inverse();
    places.push_back({world_from_cam.translation,
                      world_from_cam.rotation * Eigen::Vector3d::UnitZ()});
    largest = std::max(largest,
                       (places.back().center - places.front().center).norm());
  }
  for (Place& place : places) place.center /= largest > 0 ? largest : 1;
  return places;
}

}  // namespace

std::vector<int> SpreadViews(const Scene& scene, int count) {
  const std::vector<Place> places = PlacesOf(scene);
  std::vector<double> farness(places.size(),
                              std::numeric_limits<double>::infinity());
  std::vector<int> chosen;
  while (static_cast<int>(chosen.size()) < count &&
         chosen.size() < places.size()) {
    const auto farthest = std::max_element(farness.begin(), farness.end());
    const auto idx = static_cast<std::size_t>(farthest - farness.begin());
    chosen.push_back(static_cast<int>(idx));
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double distance =
          (places[i].center - places[idx].center).norm() +
          (places[i].direction - places[idx].direction).norm();
      farness[i] = std::min(farness[i], distance);
    }
    farness[idx] = -1;
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace curvix
