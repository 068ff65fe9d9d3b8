// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/adjustable_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "colmap/inconsistent_points.h"
#include "geometry/fit_point.h"

namespace curvix {
namespace {

// The i-th observation of `point`.
PointInImage Observation(const Scene& scene,
                         const ScenePoint& point,
                         std::size_t i) {
  const View& view = scene.views[static_cast<std::size_t>(point.view_idxs[i])];
  return {&CameraOf(scene, view), view.cam_from_world, point.pixels[i]};
}

// Whether the i-th observation is finite and in front of its camera.
bool IsUsable(const Scene& scene, const ScenePoint& point, std::size_t i) {
  const PointInImage seen = Observation(scene, point, i);
  return seen.pixel.allFinite() &&
         Project(*seen.camera, seen.cam_from_world, point.position);
}

// The names of the views with too few observations.
std::vector<std::string> WeakViews(const Scene& scene) {
  std::vector<std::size_t> counts(scene.views.size(), 0);
  for (const ScenePoint& point : scene.points) {
    for (const int view_idx : point.view_idxs) {
      ++counts[static_cast<std::size_t>(view_idx)];
    }
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    if (counts[i] < kMinObservationsPerView) {
      names.push_back(scene.views[i].name);
    }
  }
  return names;
}

}  // namespace

Scene AdjustableScene(const ColmapModel& model) {
  std::vector<std::string> left_out;
  while (true) {
    Scene scene = SceneFromColmapModel(model, {}, left_out);
    for (ScenePoint& point : scene.points) {
      KeepObservations([&](std::size_t i) { return IsUsable(scene, point, i); },
                       &point);
    }
    std::erase_if(scene.points, [](const ScenePoint& point) {
      return point.view_idxs.size() < 2;
    });
    const std::vector<std::string> weak = WeakViews(scene);
    if (weak.empty()) return scene;
    left_out.insert(left_out.end(), weak.begin(), weak.end());
    std::ranges::sort(left_out);
  }
}

void KeepObservations(const std::function<bool(std::size_t)>& keep,
                      ScenePoint* point) {
  std::size_t num_kept = 0;
  for (std::size_t i = 0; i < point->pixels.size(); ++i) {
    if (!keep(i)) continue;
    point->view_idxs[num_kept] = point->view_idxs[i];
    point->pixels[num_kept] = point->pixels[i];
    ++num_kept;
  }
  point->view_idxs.resize(num_kept);
  point->pixels.resize(num_kept);
}

ColmapModel ModelWithScene(ColmapModel model, const Scene& scene) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    model.cameras[i].camera = scene.cameras[i];
  }
  std::map<std::uint32_t, const View*> views;
  for (const View& view : scene.views) views[view.image_id] = &view;
  for (ColmapImage& image : model.images) {
    const auto view = views.find(image.image_id);
    if (view == views.end()) continue;
    image.cam_from_world = view->second->cam_from_world;
  }
  std::map<std::uint64_t, const ScenePoint*> points;
  for (const ScenePoint& point : scene.points) {
    points[point.point3D_id] = &point;
  }
  for (ColmapPoint3D& target : model.points) {
    const auto point = points.find(target.point3D_id);
    if (point == points.end()) continue;
    target.position = point->second->position;
    double sum = 0;
    const auto errors = ReprojectionErrors(scene, *point->second);
    for (const double error : errors) sum += error;
    const double mean = sum / static_cast<double>(errors.size());
    target.error = std::isfinite(mean) ? mean : -1;
  }
  return model;
}

Eigen::Vector3d FitPoint(const Scene& scene, const ScenePoint& point) {
  std::vector<PointInImage> seen;
  for (std::size_t i = 0; i < point.pixels.size(); ++i) {
    seen.push_back(Observation(scene, point, i));
  }
  return FitPoint(point.position, seen);
}

void FitPoints(Scene* scene) {
  for (ScenePoint& point : scene->points) {
    point.position = FitPoint(*scene, point);
  }
}

}  // namespace curvix
