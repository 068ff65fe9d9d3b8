// SPDX-License-Identifier: BSD-3-Clause
#include "paper/wedge_support.h"

#include <cmath>

#include "base/angles.h"

namespace curvix {

WedgeSupport::WedgeSupport(const EpipolarPencil& pencil1,
                           const EpipolarPencil& pencil2,
                           const PosedView& h1,
                           const PosedView& h2,
                           const PosedView& view,
                           const std::vector<Edge2d>& edges,
                           double tolerance_px)
    : angles1_(pencil1, h1),
      angles2_(pencil2, h2),
      view_angles2_(pencil2, view),
      edges_(&edges),
      tolerance_px_(tolerance_px),
      sorted1_(EpipolarAngles(pencil1, view), edges, tolerance_px) {}

std::optional<std::int32_t> WedgeSupport::Find(const ImageEdge& edge1,
                                               const ImageEdge& edge2,
                                               const ImageEdge& projected,
                                               double max_angle_rad) const {
  const auto wedge1 = WedgeOf(angles1_, edge1.position, tolerance_px_);
  const auto wedge2 = WedgeOf(angles2_, edge2.position, tolerance_px_);
  if (!wedge1 || !wedge2) return std::nullopt;
  std::optional<std::int32_t> nearest;
  double least = 0;
  const double angle = std::atan2(projected.tangent.y(), projected.tangent.x());
  for (const std::int32_t idx : sorted1_.Meeting(*wedge1)) {
    const Edge2d& edge = (*edges_)[static_cast<std::size_t>(idx)];
    if (UndirectedDifference(static_cast<double>(edge.angle), angle) >
        max_angle_rad) {
      continue;
    }
    const auto own = WedgeOf(view_angles2_, edge.position, tolerance_px_);
    if (!own || !Meet(*own, *wedge2)) continue;
    const double distance = (edge.position - projected.position).squaredNorm();
    if (!nearest || distance < least) {
      nearest = idx;
      least = distance;
    }
  }
  return nearest;
}

}  // namespace curvix
