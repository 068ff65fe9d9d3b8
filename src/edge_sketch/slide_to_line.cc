// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/slide_to_line.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace curvix {
namespace {

// `edge` slid along its tangent onto `line`; nullopt beyond max_shift_px, which
// covers tangents parallel to the line.
std::optional<ImageEdge> Slide(const ImageEdge& edge,
                               const Line2& line,
                               double max_shift_px) {
  const double distance = line.SignedDistance(edge.position);
  const double sine = line.normal.dot(edge.tangent);
  if (!(std::abs(distance) <= max_shift_px * std::abs(sine))) {
    return std::nullopt;
  }
  const double shift = sine == 0 ? 0 : -distance / sine;
  return ImageEdge{edge.position + shift * edge.tangent, edge.tangent};
}

// The tangent turned towards the line's normal by at most max_turn_rad.
Eigen::Vector2d TurnTowardsNormal(const Eigen::Vector2d& tangent,
                                  const Line2& line,
                                  double max_turn_rad) {
  const double sine = line.normal.dot(tangent);
  const double cosine = line.Direction().dot(tangent);
  const double angle = std::atan2(std::abs(sine), std::abs(cosine));
  const double turn = std::min(max_turn_rad, kPi / 2 - angle);
  // Positive turns go from the line's direction away from its normal. Edges
  // parallel to the line turn the same way whatever the signs of both.
  const double sign = sine * cosine > 0 ? -1.0 : 1.0;
  return Eigen::Rotation2Dd(sign * turn) * tangent;
}

}  // namespace

std::optional<ImageEdge> SlideToLine(const ImageEdge& edge,
                                     const Line2& line,
                                     double location_tolerance_px,
                                     const ConsolidationOptions& options) {
  if (auto slid = Slide(edge, line, options.max_tangent_shift_px)) {
    return slid;
  }
  const ImageEdge turned{
      edge.position,
      TurnTowardsNormal(edge.tangent, line, DegToRad(options.max_turn_deg))};
  if (auto slid = Slide(turned, line, options.max_tangent_shift_px)) {
    return slid;
  }
  const double distance = line.SignedDistance(edge.position);
  if (std::abs(distance) > location_tolerance_px) return std::nullopt;
  return ImageEdge{edge.position - distance * line.normal, edge.tangent};
}

}  // namespace curvix
