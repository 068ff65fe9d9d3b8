// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/curves_as_points.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "io/curve_style.h"

namespace curvix {
namespace {

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
    AddObservation(edge.pixel,
                   model.images[static_cast<std::size_t>(ref.view_idx)],
                   point);
    point.error += std::abs(edge.residual_px);
  }
  point.error /= static_cast<double>(edges.size());
  model.points.push_back(std::move(point));
}

}  // namespace

ColmapModel CurvesAsPoints(const CurveRecord& record) {
  ColmapModel model = ModelOfViews(record.scene);
  record.curves.ForEach([&](std::size_t id, const Curve& curve) {
    for (const CurveSample& sample : curve.samples) {
      AddSample(record, sample, CurveColor(id), model);
    }
  });
  return model;
}

}  // namespace curvix
