// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. All edges of one view. Beyond the paper, its noise,
// the selection of its contours, and the shift of parallel edges.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstdint>
#include <vector>

#include "base/gray_image.h"
#include "edge_detection/third_order_edges.h"

namespace curvix {

// The edges of the view's image, linked along its contours and mapped to the
// ideal pinhole of `camera`, which is the view's. Crowded images, which have
// more edges than MaxEdges(), are seen at the coarser scale. Isolated edges,
// and the least prominent contours of crowded images, are dropped and counted:
// see KeepContours(). kInvalidArgument: the image is not of the camera's size.
// Other errors: those of LoadGrayImage().
Result<EdgeMap> DetectViewEdges(const View& view,
                                const Camera& camera,
                                const EdgeDetectionOptions& options);

// The standard deviation of the image noise in grey levels, as the edge filters
// see it. 0 without noise, and where it cannot be estimated: images below 5 x 5
// pixels, or clipped (black or white) everywhere.
//
// A robust form of Immerkaer's (1996) method at the scale of the edge filters:
// the median size of the Laplacian of the image smoothed by about 1 px, over
// the flatter half of the pixels that are not clipped. Finer masks would not
// do, since JPEG removes the finest noise and leaves what edges are made of.
// Flatness is decided by the gradient of the same smoothed image, which in
// stationary noise is independent of the Laplacian at the same place, so that
// the choice does not bias the estimate. Smooth shading has no Laplacian;
// texture finer than a few pixels counts as noise where it covers most of the
// image. The noise of 8-bit rounding, 1/12 of a squared grey level, is taken
// off.
double EstimateNoise(const GrayImage& image);

// Weakest gradient, of an image smoothed by `sigma_px`, that counts as an edge
// where the image noise has standard deviation `noise`: max(min_gradient,
// noise_factor * standard deviation of the gradient of the noise). Grey levels
// per pixel.
double GradientThreshold(const EdgeDetectionOptions& options,
                         double sigma_px,
                         double noise);

// Most edges that are kept of an image of that size: at least 20,000, and of n
// million pixels n^0.8 times options.max_edges_per_megapixel.
std::int64_t MaxEdges(const EdgeDetectionOptions& options,
                      int width,
                      int height);

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

// The detector sees steps blurred by a Gaussian. Its standard deviation w
// follows from the median sharpness. Two steps within some 4 w add up: of a
// thin line, dark to bright and back, the two peaks of the gradient lie too far
// apart, at least 2 w; of a staircase, too close together. Positions and
// strengths of the two peaks determine both steps. Each edge is corrected for
// the nearest parallel edge (37 degrees) on either side, by at most 0.6 w each,
// since peaks hardly resolve steps nearer than w. `spacing_px`: the mean
// distance between edges along a contour (EdgeMap).
void SeparateEdges(double spacing_px, std::vector<Edge2d>* edges);

}  // namespace curvix
