// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/detect_view_edges.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "edge_detection/curvelets.h"
#include "edge_detection/gaussian_derivatives.h"
#include "edge_detection/image_noise.h"
#include "edge_detection/keep_contours.h"
#include "edge_detection/load_image.h"
#include "edge_detection/prominence.h"
#include "edge_detection/separate_edges.h"
#include "edge_detection/third_order_edges.h"
#include "edge_detection/undistort_edges.h"

namespace curvix {
namespace {

// The least prominent edges of a crowded image are dropped before they are
// linked: those beyond so many times what is kept.
constexpr std::int64_t kCrowd = 2;
// Contours of crowded images are thinned to one edge a pixel, so that three
// times as many of them fit into the limit.
constexpr std::int64_t kThinning = 3;
constexpr double kThinnedSpacingPx = 1.2;

// Drops contours that do not fit.
void KeepWithinLimit(const EdgeDetectionOptions& options,
                     std::int64_t max_edges,
                     EdgeMap* map) {
  KeptEdges kept =
      KeepContours(map->edges, map->neighbors, options, 0, max_edges, {});
  if (kept.num_over_limit == 0) return;
  map->edges = std::move(kept.edges);
  // Breaks beside edges that are gone close.
  map->neighbors = LinkNeighbors(map->edges, options);
  map->num_dropped_over_limit += kept.num_over_limit;
}

Result<std::int32_t> DropMaskedEdges(const View& view,
                                     const Camera& camera,
                                     std::vector<LocatedEdge>* edges) {
  if (view.mask_path.empty()) return 0;
  const Result<GrayImage> mask =
      LoadGrayImage(view.mask_path, ImageSize{camera.width, camera.height});
  if (!mask.ok()) return mask.status();
  return DropMaskedEdges(*mask, edges);
}

// The edges of the view's image that the mask leaves, but for the crowd of the
// least prominent.
Result<std::vector<Edge2d>> LocateProminentEdges(
    const GrayImage& image,
    const View& view,
    const Camera& camera,
    const EdgeDetectionOptions& options,
    double min_gradient,
    EdgeMap* map) {
  std::vector<LocatedEdge> edges = LocateEdges(image, options, min_gradient);
  const Result<std::int32_t> num_masked = DropMaskedEdges(view, camera, &edges);
  if (!num_masked.ok()) return num_masked.status();
  map->num_dropped_masked = *num_masked;
  const std::int64_t max_edges = MaxEdges(options, image.width, image.height);
  if (static_cast<std::int64_t>(edges.size()) > max_edges) {
    MeasureCrowding(&edges);
  }
  map->num_dropped_over_limit =
      DropLeastProminent(kCrowd * kThinning * max_edges, &edges);
  return AcrossGradients(edges);
}

// Of these the edges of contours worth keeping. They are thinned before they
// are oriented, which takes long. What is dropped is counted and its memory
// freed.
Status LocateContours(const GrayImage& image,
                      const View& view,
                      const Camera& camera,
                      const EdgeDetectionOptions& options,
                      EdgeMap* map) {
  const double min_gradient = GradientThreshold(options, map->noise);
  const auto edges =
      LocateProminentEdges(image, view, camera, options, min_gradient, map);
  if (!edges.ok()) return edges.status();
  const std::int64_t max_edges = MaxEdges(options, image.width, image.height);
  KeptEdges kept = KeepContours(*edges,
                                LinkNeighbors(*edges, options),
                                options,
                                min_gradient,
                                kThinning * max_edges,
                                {max_edges, kThinnedSpacingPx});
  map->num_dropped_isolated = kept.num_isolated;
  map->num_dropped_over_limit += kept.num_over_limit;
  map->edges = std::move(kept.edges);
  if (kept.num_thinned_out > 0) {
    const auto size = static_cast<double>(map->edges.size());
    map->spacing_px *= (kept.num_thinned_out + size) / size;
  }
  return Status();
}

}  // namespace

double GradientThreshold(const EdgeDetectionOptions& options, double noise) {
  return std::max(
      options.min_gradient,
      options.noise_factor * noise * GradientNoiseGain(options.sigma_px));
}

std::int64_t MaxEdges(const EdgeDetectionOptions& options,
                      int width,
                      int height) {
  constexpr double kAlwaysAllowed = 10000;
  // More than any image has, and still an integer.
  constexpr double kUnlimited = 1e15;
  const double megapixels = 1e-6 * width * height;
  return static_cast<std::int64_t>(
      std::clamp(options.max_edges_per_megapixel * megapixels,
                 kAlwaysAllowed,
                 kUnlimited));
}

Result<EdgeMap> DetectViewEdges(const View& view,
                                const Camera& camera,
                                const EdgeDetectionOptions& options) {
  const Result<GrayImage> image = LoadGrayImage(view, camera);
  if (!image.ok()) return image.status();
  EdgeMap map;
  map.noise = EstimateNoise(*image);
  if (Status status = LocateContours(*image, view, camera, options, &map);
      !status.ok()) {
    return status;
  }
  OrientEdges(*image, options, &map.edges);
  map.neighbors = LinkNeighbors(map.edges, options);
  if (options.separate_edges) SeparateEdges(map.spacing_px, &map.edges);
  const std::int64_t max_edges = MaxEdges(options, image->width, image->height);
  if (static_cast<std::int64_t>(map.edges.size()) > max_edges) {
    KeepWithinLimit(options, max_edges, &map);
  }
  return UndistortEdges(std::move(map), camera);
}

}  // namespace curvix
