// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 7.
#include "alignment/forces.h"

namespace curvix {

Pull PullOn(std::size_t edge_idx,
            std::span<const NeighborLink> neighbors,
            const std::vector<OrientedPoint>& points,
            const ForceModel& model) {
  const OrientedPoint& point = points[edge_idx];
  Pull sum;
  double sum_weights = 0;
  for (const NeighborLink& link : neighbors) {
    const OrientedPoint& other =
        points[static_cast<std::size_t>(link.edge_idx)];
    const Eigen::Vector3d offset = other.position - point.position;
    const Eigen::Vector3d direction = point.tangent.dot(other.tangent) < 0
                                          ? Eigen::Vector3d(-other.tangent)
                                          : other.tangent;
    const double weight = link.Weight() / (offset.norm() + model.half_distance);
    // u is not normalised; u.u is at least 1, as the two unit vectors are at
    // most a right angle apart.
    const Eigen::Vector3d u = model.use_mean_direction
                                  ? Eigen::Vector3d(direction + point.tangent)
                                  : direction;
    sum.force += weight * (offset - (offset.dot(u) / u.squaredNorm()) * u);
    sum.torque += weight * direction;
    sum_weights += weight;
  }
  if (!(sum_weights > 0)) return {};
  const Eigen::Vector3d mean_direction = sum.torque / sum_weights;
  return {sum.force / sum_weights,
          mean_direction - mean_direction.dot(point.tangent) * point.tangent};
}

}  // namespace curvix
