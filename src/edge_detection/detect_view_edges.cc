// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/detect_view_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "edge_detection/curvelets.h"
#include "edge_detection/gaussian_derivatives.h"
#include "edge_detection/load_image.h"
#include "edge_detection/undistort_edges.h"
#include "geometry/detected_edge.h"

namespace curvix {
namespace {

// Contours of crowded images are thinned to an edge each 1.4 px, so that more
// of them fit into the limit.
constexpr double kThinnedSpacingPx = 1.4;
// Before that, how many times the limit is kept, counted in edges sampled twice
// a pixel: of single edges, the most prominent, and of contours.
constexpr std::int64_t kMaxProminent = 6;
constexpr std::int64_t kMaxOfContours = 3;

// Steps of Newton's method from the coarser to the finer scale, and how far
// apart the places of an edge at both scales may be.
constexpr int kNumFineSteps = 2;
constexpr double kMaxFineShiftPx = 0.8;

// The image of a view in which edges are sought.
struct ViewImage {
  const GrayImage& pixels;
  const std::optional<GrayImage>& mask;
  double noise;  // grey levels
};

struct LocatedContours {
  EdgeMap map;              // without orientations and neighbors
  bool is_crowded = false;  // more edges than the limit
};

// Drops contours that do not fit.
void KeepWithinLimit(const EdgeDetectionOptions& options,
                     std::int64_t max_edges,
                     EdgeMap* map) {
  ContourLimits limits;
  limits.spacing_px = map->spacing_px;
  limits.max_edges = max_edges;
  KeptEdges kept = KeepContours(map->edges, map->neighbors, options, limits);
  if (kept.num_over_limit == 0) return;
  map->edges = std::move(kept.edges);
  // Breaks beside edges that are gone close.
  map->neighbors = LinkNeighbors(map->edges, options);
  map->num_dropped_over_limit += kept.num_over_limit;
}

// The edges of contours worth keeping. They are thinned before they are
// oriented, which takes long. What is dropped is counted and its memory freed.
LocatedContours LocateContours(const ViewImage& image,
                               const DetectionScale& scale,
                               const EdgeDetectionOptions& options) {
  LocatedContours located;
  EdgeMap& map = located.map;
  map.noise = image.noise;
  map.spacing_px = scale.spacing_px();
  const auto edges_of = [&](std::int64_t sampled_twice_a_pixel) {
    return std::llround(static_cast<double>(sampled_twice_a_pixel) /
                        (2 * map.spacing_px));
  };
  const std::int64_t limit =
      MaxEdges(options, image.pixels.width, image.pixels.height);
  ContourLimits limits;
  limits.min_gradient = GradientThreshold(options, scale.sigma_px, map.noise);
  limits.spacing_px = map.spacing_px;
  limits.max_edges = edges_of(kMaxOfContours * limit);
  limits.max_unthinned_edges = edges_of(limit);
  limits.thinned_spacing_px = kThinnedSpacingPx;

  std::vector<LocatedEdge> all =
      LocateEdges(image.pixels, scale, limits.min_gradient);
  if (image.mask) map.num_dropped_masked = DropMaskedEdges(*image.mask, &all);
  if (std::ssize(all) > limits.max_unthinned_edges) {
    MeasureCrowding(map.spacing_px, &all);
  }
  map.num_dropped_over_limit =
      DropLeastProminent(edges_of(kMaxProminent * limit), &all);
  const std::vector<Edge2d> edges = AcrossGradients(all);
  KeptEdges kept =
      KeepContours(edges, LinkNeighbors(edges, options), options, limits);
  map.num_dropped_isolated = kept.num_isolated;
  map.num_dropped_over_limit += kept.num_over_limit;
  map.edges = std::move(kept.edges);
  located.is_crowded =
      map.num_dropped_over_limit > 0 || kept.num_thinned_out > 0;
  if (kept.num_thinned_out > 0) {
    const auto size = static_cast<double>(map.edges.size());
    map.spacing_px *= (kept.num_thinned_out + size) / size;
  }
  return located;
}

// Sets EdgeMap::fine_variance_gain_px2, and Edge2d::fine_px of edges that have
// a peak at the finer scale, too.
void MeasureAtFinerScale(const GrayImage& image,
                         const DetectionScale& coarse,
                         const EdgeDetectionOptions& options,
                         EdgeMap* map) {
  map->fine_variance_gain_px2 =
      coarse.sigma_px * coarse.sigma_px - options.sigma_px * options.sigma_px;
  std::vector<Edge2d> fine = map->edges;
  for (int i = 0; i < kNumFineSteps; ++i) {
    OrientEdges(image, options.sigma_px, true, &fine);
  }
  if (options.separate_edges) SeparateEdges(map->spacing_px, &fine);
  SmoothContours(map->neighbors, &fine);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    Edge2d& edge = map->edges[i];
    const double shift_px =
        (fine[i].position - edge.position).dot(ToBrightSide(edge));
    if (fine[i].sharpness > 0 && std::abs(shift_px) <= kMaxFineShiftPx) {
      edge.fine_px = Eigen::half(static_cast<float>(shift_px));
    }
  }
}

// The edges of `image`, oriented and linked.
EdgeMap DetectAtScale(const ViewImage& image,
                      const DetectionScale& scale,
                      const EdgeDetectionOptions& options,
                      LocatedContours located) {
  EdgeMap map = std::move(located.map);
  const bool is_coarse = scale.samples_per_px == 1;
  // Between pixels the parabola is less exact than between half pixels.
  const bool refine = is_coarse;
  OrientEdges(image.pixels, scale.sigma_px, refine, &map.edges);
  map.neighbors = LinkNeighbors(map.edges, options);
  if (options.separate_edges) SeparateEdges(map.spacing_px, &map.edges);
  const std::int64_t max_edges =
      MaxEdges(options, image.pixels.width, image.pixels.height);
  if (std::ssize(map.edges) > max_edges) {
    KeepWithinLimit(options, max_edges, &map);
  }
  if (is_coarse) {
    SmoothContours(map.neighbors, &map.edges);
    MeasureAtFinerScale(image.pixels, scale, options, &map);
  }
  return map;
}

// Crowded images have their edges at the coarser scale, others at the finer
// one.
EdgeMap DetectEdgesIn(const ViewImage& image,
                      const EdgeDetectionOptions& options) {
  if (options.crowded_scale > 1) {
    const DetectionScale coarse = {options.crowded_scale * options.sigma_px, 1};
    LocatedContours located = LocateContours(image, coarse, options);
    if (located.is_crowded) {
      return DetectAtScale(image, coarse, options, std::move(located));
    }
  }
  const DetectionScale fine = {options.sigma_px, 2};
  return DetectAtScale(
      image, fine, options, LocateContours(image, fine, options));
}

}  // namespace

double GradientThreshold(const EdgeDetectionOptions& options,
                         double sigma_px,
                         double noise) {
  return std::max(options.min_gradient,
                  options.noise_factor * noise * GradientNoiseGain(sigma_px));
}

std::int64_t MaxEdges(const EdgeDetectionOptions& options,
                      int width,
                      int height) {
  constexpr double kAlwaysAllowed = 20000;
  // A finer image shows the same contours, longer, and more of the small ones.
  constexpr double kGrowth = 0.8;
  // More than any image has, and still an integer.
  constexpr double kUnlimited = 1e15;
  const double megapixels = 1e-6 * width * height;
  return static_cast<std::int64_t>(std::clamp(
      options.max_edges_per_megapixel * std::pow(megapixels, kGrowth),
      kAlwaysAllowed,
      kUnlimited));
}

Result<EdgeMap> DetectViewEdges(const View& view,
                                const Camera& camera,
                                const EdgeDetectionOptions& options) {
  CURVIX_ASSIGN_OR_RETURN(const GrayImage image, LoadGrayImage(view, camera));
  CURVIX_ASSIGN_OR_RETURN(const std::optional<GrayImage> mask,
                          LoadMask(view, camera));
  EdgeMap map = DetectEdgesIn({image, mask, EstimateNoise(image)}, options);
  map = UndistortEdges(std::move(map), camera);
  map.unseen = FindUnseenCells(camera, mask);
  return map;
}

}  // namespace curvix
