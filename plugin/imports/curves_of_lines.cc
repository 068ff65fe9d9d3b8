// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/curves_of_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace curvix {
namespace {

const Camera& CameraOf(const Scene& scene, const View& view) {
  return scene.cameras[static_cast<std::size_t>(view.camera_idx)];
}

bool IsSeenBySome(const ImportedLine& line, const Scene& scene) {
  return std::any_of(
      scene.views.begin(), scene.views.end(), [&](const View& view) {
        return ProjectPoint(
                   (line.start + line.end) / 2, view, CameraOf(scene, view))
            .has_value();
      });
}

// Where the view, which sees it, sees the sample, and in which direction.
Edge2d EdgeAt(const CurveSample& sample,
              const View& view,
              const Camera& camera) {
  const Eigen::Matrix3d calibration = PinholeCalibration(camera);
  const Eigen::Vector3d position =
      calibration * (view.cam_from_world * sample.position);
  const Eigen::Vector3d tangent =
      calibration * (view.cam_from_world.rotation * sample.tangent);
  Edge2d edge;
  edge.position = position.hnormalized();
  const Eigen::Vector2d along = tangent.head<2>() - tangent.z() * edge.position;
  edge.angle = static_cast<float>(std::atan2(along.y(), along.x()));
  return edge;
}

Curve CurveOf(const ImportedLine& line,
              const Scene& scene,
              const std::map<std::uint32_t, std::int32_t>& view_of_image,
              std::vector<EdgeMap>& edge_maps) {
  std::vector<std::int32_t> views;
  for (const std::uint32_t image_id : line.image_ids) {
    const auto view = view_of_image.find(image_id);
    if (view != view_of_image.end()) views.push_back(view->second);
  }
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  Curve curve;
  for (const Eigen::Vector3d& position : {line.start, line.end}) {
    CurveSample& sample = curve.samples.emplace_back();
    sample.position = position;
    sample.tangent = (line.end - line.start).normalized();
    for (const std::int32_t view_idx : views) {
      const View& view = scene.views[static_cast<std::size_t>(view_idx)];
      const Camera& camera = CameraOf(scene, view);
      if (!ProjectPoint(position, view, camera)) continue;
      EdgeMap& map = edge_maps[static_cast<std::size_t>(view_idx)];
      sample.support.push_back(
          {view_idx, static_cast<std::int32_t>(map.edges.size())});
      map.edges.push_back(EdgeAt(sample, view, camera));
      map.neighbors.emplace_back();
    }
  }
  return curve;
}

}  // namespace

Result<LineCurves> CurvesOfLines(const std::vector<ImportedLine>& lines,
                                 const Scene& scene) {
  LineCurves result;
  result.num_seen = static_cast<int>(
      std::count_if(lines.begin(), lines.end(), [&](const ImportedLine& line) {
        return IsSeenBySome(line, scene);
      }));
  if (result.num_seen == 0) {
    return Status(StatusCode::kInvalidArgument,
                  "no image of the model sees any of the lines: they are of "
                  "another world; name the workspace that they were made of "
                  "with --workspace_path");
  }
  std::map<std::uint32_t, std::int32_t> view_of_image;
  for (const View& view : scene.views) {
    const auto view_idx = static_cast<std::int32_t>(view_of_image.size());
    view_of_image.emplace(view.image_id, view_idx);
  }
  result.edge_maps.resize(scene.views.size());
  for (const ImportedLine& line : lines) {
    if ((line.end - line.start).norm() > 0) {
      result.curves.curves.push_back(
          CurveOf(line, scene, view_of_image, result.edge_maps));
    } else {
      ++result.num_without_length;
    }
  }
  return result;
}

}  // namespace curvix
