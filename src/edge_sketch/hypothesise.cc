// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/hypothesise.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/angles.h"
#include "geometry/detected_edge.h"

namespace curvix {
namespace {

constexpr std::size_t kUsualNumCandidates = 64;  // to reserve memory for
// Smallest angle between an edge and its epipolar line: below it, small errors
// move the point where they meet far along the line.
constexpr double kMinEpipolarAngle = DegToRad(5);

// Of the appearance of two edges that are paired.
constexpr double kMinLikelihoodRatio = 0.1;

}  // namespace

HypothesisViews::HypothesisViews(const EpipolarPencil& pencil,
                                 const PosedView& h1,
                                 const PosedView& h2,
                                 const std::vector<Edge2d>& edges2,
                                 const DepthRange& depths,
                                 const Options& options,
                                 const AppearanceDensity* appearance2)
    : h1_(&h1),
      h2_(&h2),
      edges2_(&edges2),
      appearance2_(appearance2),
      options_(&options),
      baseline_(pencil.baseline()),
      angles1_(pencil, h1),
      line_from_normal_(h1.calibration.inverse().transpose()),
      fundamental_(FundamentalMatrix(h1, h2)),
      depths_(depths),
      projection_(h1, h2),
      sorted2_(EpipolarAngles(pencil, h2),
               edges2,
               options.hypotheses.location_tolerance_px) {}

bool HypothesisViews::LookAlike(const Appearance& look1,
                                const Edge2d& edge2,
                                const Eigen::Vector2d& tangent2,
                                bool cross_alike) const {
  auto look2 = appearance2_->AppearanceOf(edge2, tangent2);
  if (!look2) return true;
  if (!cross_alike) look2->SwapSides();
  return LikelihoodRatio(*look2, look1) >= kMinLikelihoodRatio;
}

double HypothesisViews::CrossingSine(const ImageEdge& edge1) const {
  // The epipolar plane of the edge meets the image in its epipolar line.
  const Eigen::Vector3d normal = h1_->Ray(edge1.position).cross(baseline_);
  const Eigen::Vector3d line = line_from_normal_ * (h1_->rotation * normal);
  return line.head<2>().dot(edge1.tangent) / line.head<2>().norm();
}

Interval HypothesisViews::SearchAlong(const Line2& line,
                                      const Eigen::Vector2d& pixel1) const {
  const ConsolidationOptions& options = options_->consolidation;
  Interval along =
      projection_.SeenAlong(line, pixel1, depths_.nearest, depths_.farthest);
  along.begin -= options.max_tangent_shift_px;
  along.end += options.max_tangent_shift_px;
  return along;
}

Hypotheses HypothesisViews::Hypothesise(const Edge2d& edge1) const {
  Hypotheses result;
  const ImageEdge image_edge1 = ToImageEdge(edge1);
  const double sine1 = CrossingSine(image_edge1);
  if (std::abs(sine1) < std::sin(kMinEpipolarAngle)) return result;
  const auto look1 = appearance2_ ? AppearanceAlong(edge1) : std::nullopt;
  const double tolerance_px = options_->hypotheses.location_tolerance_px;
  const auto wedge = WedgeOf(angles1_, edge1.position, tolerance_px);
  if (!wedge) return result;
  const Line2 line = EpipolarLine(fundamental_, edge1.position);

  const Interval search = SearchAlong(line, edge1.position);
  const Eigen::Vector2d direction = line.Direction();
  std::vector<LineEdge> on_line;
  on_line.reserve(kUsualNumCandidates);
  sorted2_.VisitMeeting(*wedge, [&](std::int32_t edge_idx) {
    const Edge2d& edge2 = (*edges2_)[static_cast<std::size_t>(edge_idx)];
    if (!search.Contains(direction.dot(edge2.position))) return;
    const ImageEdge image_edge2 = ToImageEdge(edge2);
    // The normals of both lines point to the same side of the epipolar plane.
    const bool cross_alike = sine1 * line.normal.dot(image_edge2.tangent) > 0;
    if (look1 && !LookAlike(*look1, edge2, image_edge2.tangent, cross_alike))
      return;
    const auto moved =
        SlideToLine(image_edge2, line, tolerance_px, options_->consolidation);
    if (moved) on_line.push_back({*moved, edge_idx});
  });
  const double min_sine = std::sin(kMinEpipolarAngle);
  result.virtual_edges = ClusterEdges(on_line, line, options_->consolidation);
  result.hypotheses.reserve(result.virtual_edges.edges.size());
  for (const VirtualEdge& virtual_edge : result.virtual_edges.edges) {
    if (std::abs(line.normal.dot(virtual_edge.edge.tangent)) < min_sine) {
      continue;
    }
    const auto edge =
        TriangulateEdge(*h1_,
                        image_edge1,
                        *h2_,
                        virtual_edge.edge,
                        DegToRad(options_->hypotheses.min_ray_angle_deg) / 2,
                        DegToRad(1));
    if (!edge) continue;
    result.hypotheses.push_back({*edge, image_edge1, virtual_edge});
  }
  return result;
}

}  // namespace curvix
