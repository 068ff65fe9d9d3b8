// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/hypothesise.h"

#include <cmath>

#include "base/angles.h"
#include "edge_sketch/slide_to_line.h"
#include "geometry/detected_edge.h"

namespace curvix {
namespace {

constexpr std::size_t kUsualNumCandidates = 64;  // to reserve memory for
// Smallest angle between an edge and its epipolar line: below it, small errors
// move the point where they meet far along the line.
constexpr double kMinEpipolarAngle = DegToRad(5);

// Of the appearance of two edges that are paired.
constexpr double kMinLikelihoodRatio = 0.1;

// Of edges whose tangents cross their epipolar lines to the same side, or not.
bool LookAlike(const Appearance& look1, Appearance look2, bool cross_alike) {
  if (!cross_alike) look2.SwapSides();
  return LikelihoodRatio(look2, look1) >= kMinLikelihoodRatio;
}

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
      options_(&options),
      pencil_(pencil),
      line_from_normal_(h1.calibration.inverse().transpose()),
      fundamental_(FundamentalMatrix(h1, h2)),
      depths_(depths),
      projection_(h1, h2),
      sorted2_(pencil, h2, edges2, options.hypotheses.location_tolerance_px) {
  candidates_.reserve(edges2.size());
  for (const std::int32_t edge_idx : sorted2_.EdgeIdxs()) {
    const Edge2d& edge = edges2[static_cast<std::size_t>(edge_idx)];
    candidates_.push_back({edge.position, edge.angle, edge_idx});
    if (appearance2) {
      candidates_.back().appearance =
          appearance2->AppearanceOf(edge, TangentAt(edge.angle));
    }
  }
}

double HypothesisViews::CrossingSine(const ImageEdge& edge1) const {
  // The epipolar plane of the edge meets the image in its epipolar line.
  const Eigen::Vector3d normal =
      h1_->Ray(edge1.position).cross(pencil_.baseline());
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
  const std::optional<Appearance> look1 = AppearanceAlong(edge1);
  const double tolerance_px = options_->hypotheses.location_tolerance_px;
  const auto wedge = WedgeOf(pencil_, *h1_, edge1.position, tolerance_px);
  if (!wedge) return result;
  const Line2 line = EpipolarLine(fundamental_, edge1.position);

  const Interval search = SearchAlong(line, edge1.position);
  const Eigen::Vector2d direction = line.Direction();
  std::vector<LineEdge> on_line;
  on_line.reserve(kUsualNumCandidates);
  sorted2_.VisitMeeting(*wedge, [&](std::size_t i) {
    const Candidate& candidate = candidates_[i];
    if (!search.Contains(direction.dot(candidate.position))) return;
    const Eigen::Vector2d tangent = TangentAt(candidate.angle);
    // The normals of both lines point to the same side of the epipolar plane.
    const bool cross_alike = sine1 * line.normal.dot(tangent) > 0;
    if (look1 && candidate.appearance &&
        !LookAlike(*look1, *candidate.appearance, cross_alike)) {
      return;
    }
    const auto moved = SlideToLine({candidate.position, tangent},
                                   line,
                                   tolerance_px,
                                   options_->consolidation);
    if (moved) on_line.push_back({*moved, candidate.edge_idx});
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
