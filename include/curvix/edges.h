// SPDX-License-Identifier: BSD-3-Clause
// Oriented edges, in images and in space: the 3D edge sketch is what the
// paper's Secs. 3 and 4 give to Secs. 5 and 6.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

namespace curvix {

// An oriented edge in the ideal (undistorted) pinhole image of a view.
// `angle` is that of the tangent t = (cos, sin), from +x towards +y, in
// (-pi, pi]; the image is brighter on the side of (-sin, cos), which is t
// turned a quarter from +x towards +y. Where `sharpness` is known, views are
// matched by the bright side, too; other code treats angles as equal mod pi.
struct Edge2d {
  // Pixels. Not aligned, for there may be millions: 40 bytes each. Converts to
  // Eigen::Vector2d, but is none: no reference to that can be bound to it.
  Eigen::Matrix<double, 2, 1, Eigen::DontAlign> position = {0, 0};
  float angle = 0;     // radians
  float strength = 0;  // gradient magnitude >= 0, grey levels per pixel
  // How sharp the edge is: 1 / w^2 if across it the image is a step blurred by
  // a Gaussian of standard deviation w pixels, the detector's own included; <=
  // 0 without a peak of the gradient; 0 also if it or `level` is not known.
  float sharpness = 0;
  // Brightness on the edge, half-way between its sides, grey levels (0..255).
  Eigen::half level{0};
  // How crowded both its sides are with edges: the mean strength of edges per
  // pixel beside it, on the emptier side, over its own, if contours are sampled
  // every half pixel. 0 in images with few edges, and if it is not known.
  Eigen::half crowding{0};
  // In crowded images, how far to the bright side of `position` the finer scale
  // of the detector sees the edge. There other edges beside it move it less;
  // but its places scatter more, and so link worse. Pixels; else 0.
  Eigen::half fine_px{0};
};

// The neighbours of an edge along its image contour (paper, Sec. 5): `next`
// lies in the direction of the tangent, `previous` against it. A link a.next ==
// b need not be mutual.
struct EdgeNeighbors {
  std::optional<std::int32_t> previous;
  std::optional<std::int32_t> next;
};

// The places of an ideal pinhole image at which no edge is found, by cells: on
// black pixels of the mask, and outside the photograph, whose outline is curved
// there if its lens distorts.
struct UnseenCells {
  static constexpr double kCellPx = 8;
  // Row by row, 1: unseen. Empty: none. The first cell begins margin_px before
  // the image in x and y.
  std::vector<std::uint8_t> cells;
  std::int32_t num_columns = 0;
  double margin_px = 0;

  bool Contain(const Eigen::Vector2d& pixel) const {
    if (cells.empty()) return false;
    const double column = std::floor((pixel.x() + margin_px) / kCellPx);
    const double row = std::floor((pixel.y() + margin_px) / kCellPx);
    if (!(column >= 0 && column < num_columns && row >= 0)) return false;
    const double cell = row * num_columns + column;
    return cell < static_cast<double>(cells.size()) &&
           cells[static_cast<std::size_t>(cell)] != 0;
  }
};

// All edges of one view, in detector order (row by row).
struct EdgeMap {
  std::vector<Edge2d> edges;
  std::vector<EdgeNeighbors> neighbors;  // one per edge; curves grow along
  UnseenCells unseen = {};               // a view is not queried there
  double noise = 0;  // standard deviation of the image noise, grey levels
  // The mean distance between edges along a contour. The detector samples
  // contours twice a pixel, or less in crowded images. Pixels, > 0.
  double spacing_px = 0.5;
  // How much less the variance of the blur is at the finer scale
  // (Edge2d::fine_px). Square pixels; 0 if only one scale was looked at.
  double fine_variance_gain_px2 = 0;
  // Edges that were found and dropped: where View::mask_path is black, in
  // short, weak contours, and in images with more edges than
  // EdgeDetectionOptions::max_edges_per_megapixel allows. Edges that thinning
  // removes are not counted, since their contours stay.
  std::int32_t num_dropped_isolated = 0;
  std::int32_t num_dropped_over_limit = 0;
  std::int32_t num_dropped_masked = 0;
};

// Whether an image had more edges than are kept, as photographs have: curves
// then grow (CurveGrowthOptions).
inline bool AreCrowded(const std::vector<EdgeMap>& edge_maps) {
  return std::any_of(
      edge_maps.begin(), edge_maps.end(), [](const EdgeMap& map) {
        return map.spacing_px > EdgeMap().spacing_px;
      });
}

// Names an edge of a view. Ordered by view, then edge.
struct EdgeRef {
  std::int32_t view_idx = 0;
  std::int32_t edge_idx = 0;

  friend bool operator==(const EdgeRef& a, const EdgeRef& b) {
    return a.view_idx == b.view_idx && a.edge_idx == b.edge_idx;
  }
  friend bool operator<(const EdgeRef& a, const EdgeRef& b) {
    return std::tie(a.view_idx, a.edge_idx) < std::tie(b.view_idx, b.edge_idx);
  }
};

// An oriented edge in space and the 2D edges that formed or supported it
// (paper, Sec. 3): at most one per view, ascending.
struct Edge3d {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  // unit, sign-free
  std::vector<EdgeRef> support;
  double sigma = 0;     // standard deviation across the tangent, world units;
                        // 0: not estimated
  double evidence = 0;  // how strongly the views support it; larger is stronger
};

// What became of the H1 edges and their hypotheses.
struct SketchCounts {
  std::int64_t view_pairs = 0;
  std::int64_t h1_edges = 0;     // asked for hypotheses
  std::int64_t hypotheses = 0;   // after consolidation (Sec. 4)
  std::int64_t unsupported = 0;  // hypotheses that other views did not confirm
  std::int64_t rivals = 0;       // confirmed, but another explains their edges
  // 2D edges that show a 3D edge or are next to one.
  std::int64_t used_edges = 0;
  // Not queried, see ValidationOptions::min_view_angle_deg.
  std::int64_t repeated_views = 0;
};

struct EdgeSketch {
  std::vector<Edge3d> edges;
  SketchCounts counts;
  // Standard deviation of the distance of a 2D edge from its 3D edge, as
  // estimated from the scene. Pixels, > 0.
  double edge_sigma_px = 0.15;
};

}  // namespace curvix
