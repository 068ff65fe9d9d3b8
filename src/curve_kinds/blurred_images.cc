// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/blurred_images.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "base/median.h"
#include "base/parallel.h"
#include "edge_detection/load_image.h"

namespace curvix {
namespace {

// Of all images together.
constexpr std::int64_t kMaxImageBytes = std::int64_t{1} << 30;
// Against noise and aliasing.
constexpr double kBlurPx = 0.7;

std::int64_t Bytes(const Scene& scene, int shrink) {
  std::int64_t bytes = 0;
  for (const View& view : scene.views) {
    const Camera& camera = CameraOf(scene, view);
    bytes += static_cast<std::int64_t>(camera.width / shrink) *
             (camera.height / shrink);
  }
  return bytes;
}

// The standard deviation of white noise, grey levels, by Immerkaer's (1996)
// mask, to which texture coarser than a few pixels hardly counts. It is small
// in JPEG images, which lose such noise.
double FineNoise(const GrayImage& gray) {
  constexpr int kStride = 3;
  std::vector<double> responses;
  for (int y = 1; y + 1 < gray.height; y += kStride) {
    for (int x = 1; x + 1 < gray.width; x += kStride) {
      const auto row = [&](int v) {
        return gray.at(x - 1, v) - 2 * gray.at(x, v) + gray.at(x + 1, v);
      };
      const float response = row(y - 1) - 2 * row(y) + row(y + 1);
      responses.push_back(std::abs(static_cast<double>(response)) / 6);
    }
  }
  return kSigmasPerMedian * MedianOr(0, std::move(responses));
}

BlurredImage Blur(GrayImage gray, int shrink) {
  const double noise = FineNoise(gray);
  cv::Mat image(gray.height, gray.width, CV_32F, gray.pixels.data());
  cv::Mat small = image;
  if (shrink > 1) {
    // Whole blocks only, so that the scale is exact.
    const cv::Rect whole(
        0, 0, gray.width / shrink * shrink, gray.height / shrink * shrink);
    cv::resize(image(whole),
               small,
               cv::Size(gray.width / shrink, gray.height / shrink),
               0,
               0,
               cv::INTER_AREA);
  }
  // Of white noise, the sum of the squared weights is left.
  const double gain = 1 / (4 * kPi * kBlurPx * kBlurPx) / (shrink * shrink);
  cv::Mat blurred, bytes;
  cv::GaussianBlur(small, blurred, cv::Size(), kBlurPx);
  blurred.convertTo(bytes, CV_8U);
  return {bytes.cols,
          bytes.rows,
          1.0 / shrink,
          std::vector<std::uint8_t>(bytes.begin<std::uint8_t>(),
                                    bytes.end<std::uint8_t>()),
          gain * noise * noise};
}

}  // namespace

std::vector<BlurredImage> LoadBlurredImages(const Scene& scene,
                                            int num_threads) {
  int shrink = 1;
  while (Bytes(scene, shrink) > kMaxImageBytes) shrink *= 2;
  std::vector<BlurredImage> images(scene.views.size());
  ParallelFor(images.size(), num_threads, [&](std::size_t i) {
    const View& view = scene.views[i];
    if (view.image_path.empty() && !view.image) return;
    auto gray = LoadGrayImage(view, CameraOf(scene, view));
    if (gray.ok()) images[i] = Blur(*std::move(gray), shrink);
  });
  return images;
}

}  // namespace curvix
