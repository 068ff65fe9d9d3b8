// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/bundle.h"

#include <curvix/scene.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/infinity.h"

namespace curvix {
namespace {

// Finds the observations of the tracks of a model.
class TrackReader {
 public:
  explicit TrackReader(const ColmapModel& model) : model_(model) {
    for (std::size_t i = 0; i < model.images.size(); ++i) {
      image_idxs_[model.images[i].image_id] = i;
    }
    std::map<std::uint32_t, std::size_t> camera_idxs;
    for (std::size_t i = 0; i < model.cameras.size(); ++i) {
      camera_idxs[model.cameras[i].camera_id] = i;
    }
    for (const ColmapImage& image : model.images) {
      camera_idx_.push_back(camera_idxs.at(image.camera_id));
    }
  }

  std::size_t CameraIdx(std::size_t image_idx) const {
    return camera_idx_[image_idx];
  }

  // The usable observations of `point`, one an image; view_idx is image_idx.
  std::vector<BundleObservation> Read(const ColmapPoint3D& point) const {
    std::map<std::size_t, Eigen::Vector2d> pixels;
    for (const ColmapTrackElement& element : point.track) {
      const auto image = image_idxs_.find(element.image_id);
      if (image == image_idxs_.end()) continue;
      const auto& points2D = model_.images[image->second].points2D;
      if (element.point2D_idx >= points2D.size()) continue;
      const ColmapPoint2D& point2D = points2D[element.point2D_idx];
      const Eigen::Vector2d pixel(point2D.x, point2D.y);
      if (IsUsable(image->second, point.position, pixel)) {
        pixels.emplace(image->second, pixel);
      }
    }
    std::vector<BundleObservation> observations;
    for (const auto& [image_idx, pixel] : pixels) {
      observations.push_back({image_idx, pixel});
    }
    return observations;
  }

 private:
  bool IsUsable(std::size_t image_idx,
                const Eigen::Vector3d& position,
                const Eigen::Vector2d& pixel) const {
    const Camera& camera = model_.cameras[camera_idx_[image_idx]].camera;
    const Rigid3& pose = model_.images[image_idx].cam_from_world;
    return pixel.allFinite() && Project(camera, pose, position).has_value();
  }

  const ColmapModel& model_;
  std::map<std::uint32_t, std::size_t> image_idxs_;
  std::vector<std::size_t> camera_idx_;  // of each image
};

// Drops views with too few observations, then points in fewer than two views,
// until none is left to drop. True if something was dropped.
bool DropWeak(std::size_t num_images, std::vector<BundlePoint>* points) {
  std::vector<std::size_t> counts(num_images, 0);
  for (const BundlePoint& point : *points) {
    for (const auto& seen : point.observations) ++counts[seen.view_idx];
  }
  bool dropped = false;
  for (BundlePoint& point : *points) {
    dropped |= std::erase_if(point.observations, [&](const auto& seen) {
                 return counts[seen.view_idx] < kMinObservationsPerView;
               }) > 0;
  }
  dropped |= std::erase_if(*points, [](const BundlePoint& point) {
               return point.observations.size() < 2;
             }) > 0;
  return dropped;
}

}  // namespace

Bundle BundleFromModel(const ColmapModel& model) {
  const TrackReader reader(model);
  Bundle bundle;
  for (const ColmapCamera& item : model.cameras) {
    bundle.cameras.push_back(item.camera);
  }
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    bundle.points.push_back(
        {i, model.points[i].position, reader.Read(model.points[i])});
  }
  while (DropWeak(model.images.size(), &bundle.points)) {
  }
  std::map<std::size_t, std::size_t> view_idxs;
  for (const BundlePoint& point : bundle.points) {
    for (const auto& seen : point.observations) view_idxs[seen.view_idx] = 0;
  }
  for (auto& [image_idx, view_idx] : view_idxs) {
    view_idx = bundle.views.size();
    bundle.views.push_back({image_idx,
                            reader.CameraIdx(image_idx),
                            model.images[image_idx].cam_from_world});
  }
  for (BundlePoint& point : bundle.points) {
    for (auto& seen : point.observations) {
      seen.view_idx = view_idxs.at(seen.view_idx);
    }
  }
  return bundle;
}

ColmapModel ModelWithBundle(ColmapModel model, const Bundle& bundle) {
  for (std::size_t i = 0; i < bundle.cameras.size(); ++i) {
    model.cameras[i].camera = bundle.cameras[i];
  }
  for (const BundleView& view : bundle.views) {
    model.images[view.image_idx].cam_from_world = view.cam_from_world;
  }
  for (const BundlePoint& point : bundle.points) {
    ColmapPoint3D& target = model.points[point.point_idx];
    target.position = point.position;
    double sum = 0;
    const std::vector<double> errors = ReprojectionErrors(bundle, point);
    for (const double error : errors) sum += error;
    const double mean = sum / static_cast<double>(errors.size());
    target.error = std::isfinite(mean) ? mean : -1;
  }
  return model;
}

std::vector<double> ReprojectionErrors(const Bundle& bundle,
                                       const BundlePoint& point) {
  std::vector<double> errors;
  for (const BundleObservation& seen : point.observations) {
    const BundleView& view = bundle.views[seen.view_idx];
    const auto pixel = Project(
        bundle.cameras[view.camera_idx], view.cam_from_world, point.position);
    errors.push_back(pixel ? (*pixel - seen.pixel).norm() : kInfinity);
  }
  return errors;
}

Eigen::Vector3d FitPoint(const Bundle& bundle, const BundlePoint& point) {
  std::vector<PointInImage> seen;
  for (const BundleObservation& observation : point.observations) {
    const BundleView& view = bundle.views[observation.view_idx];
    seen.push_back({&bundle.cameras[view.camera_idx],
                    view.cam_from_world,
                    observation.pixel});
  }
  return FitPoint(point.position, seen);
}

void FitPoints(Bundle* bundle) {
  for (BundlePoint& point : bundle->points) {
    point.position = FitPoint(*bundle, point);
  }
}

}  // namespace curvix
