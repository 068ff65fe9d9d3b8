// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/part_models.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>

#include "plugin/export/viewer_html.h"

namespace curvix {
namespace {

// The point with its observations in `images`, which get its pixels.
void AddPoint(const ColmapPoint3D& point,
              const std::map<std::uint32_t, const ColmapImage*>& from,
              std::map<std::uint32_t, ColmapImage*>& images,
              ColmapModel& model) {
  ColmapPoint3D copy = point;
  copy.track.clear();
  for (const ColmapTrackElement& element : point.track) {
    const auto image = images.find(element.image_id);
    if (image == images.end()) continue;
    const auto& pixels = from.at(element.image_id)->points2D;
    if (element.point2D_idx >= pixels.size()) continue;
    const ColmapPoint2D& pixel = pixels[element.point2D_idx];
    AddObservation({pixel.x, pixel.y}, *image->second, copy);
  }
  if (!copy.track.empty()) model.points.push_back(std::move(copy));
}

}  // namespace

ColmapModel ModelForPart(const ColmapModel& model,
                         const Scene& scene,
                         const std::vector<int>& view_idxs) {
  ColmapModel part;
  part.cameras = model.cameras;
  std::vector<std::uint32_t> image_ids;
  for (const int idx : view_idxs) {
    image_ids.push_back(scene.views[static_cast<std::size_t>(idx)].image_id);
  }
  std::ranges::sort(image_ids);
  const auto is_in_part = [&](std::uint32_t id) {
    return std::ranges::binary_search(image_ids, id);
  };
  std::vector<std::uint64_t> point_ids;
  for (const ColmapImage& image : model.images) {
    if (!is_in_part(image.image_id)) continue;
    part.images.push_back(image);
    for (const ColmapPoint2D& point : part.images.back().points2D) {
      if (point.point3D_id != kNoPoint3D) point_ids.push_back(point.point3D_id);
    }
  }
  std::ranges::sort(point_ids);
  point_ids.erase(std::unique(point_ids.begin(), point_ids.end()),
                  point_ids.end());
  auto point = model.points.begin();
  for (const std::uint64_t id : point_ids) {
    point = std::ranges::lower_bound(
        point, model.points.end(), id, {}, &ColmapPoint3D::point3D_id);
    if (point == model.points.end()) break;
    if (point->point3D_id != id) continue;
    part.points.push_back(*point);
    std::erase_if(part.points.back().track,
                  [&](const ColmapTrackElement& element) {
                    return !is_in_part(element.image_id);
                  });
  }
  return part;
}

ColmapModel ModelForMerge(const ColmapModel& model, const Scene& scene) {
  std::map<std::uint32_t, const ColmapImage*> from;
  for (const ColmapImage& image : model.images) from[image.image_id] = &image;
  ColmapModel merged;
  merged.cameras = model.cameras;
  std::vector<std::uint32_t> image_ids;
  for (const View& view : scene.views) image_ids.push_back(view.image_id);
  std::ranges::sort(image_ids);
  for (const std::uint32_t id : image_ids) {
    merged.images.push_back(*from.at(id));
    merged.images.back().points2D.clear();
  }
  std::map<std::uint32_t, ColmapImage*> images;
  for (ColmapImage& image : merged.images) images[image.image_id] = &image;
  // Points that do not fit their views are not in the scene.
  const std::size_t num_points = scene.points.empty() ? 0 : model.points.size();
  const std::size_t step = ViewerPointStep(num_points);
  for (std::size_t i = 0; i < num_points; i += step) {
    AddPoint(model.points[i], from, images, merged);
  }
  return merged;
}

}  // namespace curvix
