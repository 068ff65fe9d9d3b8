// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. All edges of one view.
#include "edge_detection/detect_view_edges.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "edge_detection/curvelets.h"
#include "edge_detection/gaussian_derivatives.h"
#include "edge_detection/image_noise.h"
#include "edge_detection/load_image.h"
#include "edge_detection/third_order_edges.h"
#include "edge_detection/undistort_edges.h"

namespace curvix {
namespace {

Status CheckSize(const View& view,
                 const Camera& camera,
                 const GrayImage& image) {
  if (image.width == camera.width && image.height == camera.height) return {};
  std::ostringstream message;
  message << "Image " << view.image_path.string() << " is " << image.width
          << " x " << image.height << " pixels, but its camera in the model is "
          << camera.width << " x " << camera.height
          << ". Give the images from which the model was made, or export the "
             "model at the size of these images.";
  return {StatusCode::kInvalidArgument, message.str()};
}

}  // namespace

double GradientThreshold(const EdgeDetectionOptions& options, double noise) {
  return std::max(
      options.min_gradient,
      options.noise_factor * noise * GradientNoiseGain(options.sigma_px));
}

Result<EdgeMap> DetectViewEdges(const View& view,
                                const Camera& camera,
                                const EdgeDetectionOptions& options) {
  const Result<GrayImage> image = LoadGrayImage(view.image_path);
  if (!image.ok()) return image.status();
  Status size_status = CheckSize(view, camera, *image);
  if (!size_status.ok()) return size_status;
  EdgeMap map;
  map.noise = EstimateNoise(*image);
  map.edges = DetectThirdOrderEdges(
      *image, options, GradientThreshold(options, map.noise));
  map.neighbors = LinkNeighbors(map.edges, options);
  return UndistortEdges(std::move(map), camera);
}

}  // namespace curvix
