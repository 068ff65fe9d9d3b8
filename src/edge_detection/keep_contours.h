// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Selection of the edges of an image: structure is
// more prominent than texture.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <cstdint>
#include <vector>

#include "edge_detection/third_order_edges.h"

namespace curvix {

// Keeps the `max_edges` (>= 1) edges of largest Prominence(), and those that
// are as prominent as the last of these, in their order. Returns how many it
// dropped. Their crowding is measured.
std::int32_t DropLeastProminent(std::int64_t max_edges,
                                std::vector<LocatedEdge>* edges);

// Which contours are kept.
struct ContourLimits {
  // The weakest gradient that the detector kept, grey levels per pixel.
  double min_gradient = 0;
  double spacing_px = 0.5;     // of edges along their contours, on average
  std::int64_t max_edges = 0;  // before thinning
  // If more edges are kept, contours are thinned: of each the first edge stays,
  // and then one each `thinned_spacing_px` along it, on average.
  std::int64_t max_unthinned_edges = 0;
  double thinned_spacing_px = 0;  // 0: no thinning
};

// What KeepContours() keeps, in the order in which it came, and how many edges
// it dropped.
struct KeptEdges {
  std::vector<Edge2d> edges;
  std::int32_t num_isolated = 0;
  std::int32_t num_over_limit = 0;
  std::int32_t num_thinned_out = 0;  // of contours that are kept
};

// Drops isolated edges, which are noise, mostly: contours of fewer than
// options.min_contour_edges edges, sampled twice a pixel, whose mean strength
// is below twice the weakest gradient. (Strong short contours are corners and
// tight bends.) If more than the limit are left, keeps whole contours up to the
// first that does not fit, in this order: those of options.min_contour_edges
// before shorter ones, then by mean Prominence() times the square root of the
// mean length of their straight segments, then by index. At last thins them.
// Edges and `neighbors` correspond.
KeptEdges KeepContours(const std::vector<Edge2d>& edges,
                       const std::vector<EdgeNeighbors>& neighbors,
                       const EdgeDetectionOptions& options,
                       const ContourLimits& limits);

// Sets the crowding of each edge (Edge2d::crowding). Positions are those of the
// image, strengths positive.
//
// Where a surface or an object ends, one side has no edges, or weaker ones. In
// brick, foliage and gravel both sides are crowded. The emptier side counts,
// with the mean strength of edges per pixel in a square of 9 pixels whose
// centre lies 8 pixels from the edge. What lies outside the image is empty.
// `spacing_px`: of edges along their contours; each edge counts as often as it
// has half pixels.
void MeasureCrowding(double spacing_px, std::vector<LocatedEdge>* edges);

// The strength of an edge whose crowding is measured, reduced by it; grey
// levels per pixel. A crowding of a tenth halves it, which is about that
// between two parallel contours as strong.
double Prominence(const LocatedEdge& edge);

// The same of each edge, whose crowding is measured anew, among these edges.
std::vector<double> Prominence(const std::vector<Edge2d>& edges,
                               double spacing_px);

}  // namespace curvix
