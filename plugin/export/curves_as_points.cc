// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/curves_as_points.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "io/curve_style.h"

namespace curvix {
namespace {

// Adds the edge to its image and to the track of the point.
void AddObservation(std::uint64_t point_id,
                    const Eigen::Vector2d& pixel,
                    ColmapImage& image,
                    ColmapPoint3D& point) {
  point.track.push_back(
      {image.image_id, static_cast<std::uint32_t>(image.points2D.size())});
  image.points2D.push_back({pixel.x(), pixel.y(), point_id});
}

void AddSample(const CurveRecord& record,
               const CurveSample& sample,
               const std::array<std::uint8_t, 3>& color,
               ColmapModel& model) {
  std::vector<std::pair<EdgeRef, SupportingEdge>> edges;
  for (const EdgeRef& ref : sample.support) {
    const auto edge = FindSupportingEdge(record, sample, ref);
    if (edge && edge->pixel.allFinite()) edges.emplace_back(ref, *edge);
  }
  if (edges.size() < 2) return;
  ColmapPoint3D point;
  point.point3D_id = model.points.size() + 1;
  point.position = sample.position;
  point.rgb = color;
  point.error = 0;
  for (const auto& [ref, edge] : edges) {
    AddObservation(point.point3D_id,
                   edge.pixel,
                   model.images[static_cast<std::size_t>(ref.view_idx)],
                   point);
    point.error += std::abs(edge.residual_px);
  }
  point.error /= static_cast<double>(edges.size());
  model.points.push_back(std::move(point));
}

}  // namespace

ColmapModel CurvesAsPoints(const CurveRecord& record) {
  ColmapModel model;
  for (std::size_t i = 0; i < record.scene.cameras.size(); ++i) {
    model.cameras.push_back(
        {static_cast<std::uint32_t>(i + 1), record.scene.cameras[i]});
  }
  for (const View& view : record.scene.views) {
    model.images.push_back({view.image_id,
                            view.cam_from_world,
                            static_cast<std::uint32_t>(view.camera_idx + 1),
                            view.name,
                            {}});
  }
  record.curves.ForEach([&](std::size_t id, const Curve& curve) {
    for (const CurveSample& sample : curve.samples) {
      AddSample(record, sample, CurveColor(id), model);
    }
  });
  return model;
}

}  // namespace curvix
