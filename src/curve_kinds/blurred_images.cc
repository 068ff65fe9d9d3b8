// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/blurred_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "base/median.h"
#include "base/parallel.h"
#include "base/wide_vectors.h"
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
  responses.reserve(gray.pixels.size() / (kStride * kStride));
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
  cv::Mat blurred;
  cv::GaussianBlur(small, blurred, cv::Size(), kBlurPx);
  std::vector<std::uint8_t> pixels(blurred.total());
  blurred.convertTo(cv::Mat(blurred.size(), CV_8U, pixels.data()), CV_8U);
  return {blurred.cols,
          blurred.rows,
          1.0 / shrink,
          std::move(pixels),
          gain * noise * noise};
}

}  // namespace

// In blocks, each in three loops: the first and the last are vectorised, the
// one that reads pixels cannot be.
CURVIX_WIDE_VECTORS
void BlurredImage::LookUp(std::span<const float> x,
                          std::span<const float> y,
                          float* values) const {
  constexpr std::size_t kBlock = 64;
  std::array<int, kBlock> first, p00, p01, p10, p11;
  std::array<float, kBlock> right, below;
  for (std::size_t begin = 0; begin < x.size(); begin += kBlock) {
    const std::size_t num = std::min(kBlock, x.size() - begin);
    for (std::size_t i = 0; i < num; ++i) {
      const int column = std::min(static_cast<int>(x[begin + i]), width - 2);
      const int row = std::min(static_cast<int>(y[begin + i]), height - 2);
      right[i] = x[begin + i] - static_cast<float>(column);
      below[i] = y[begin + i] - static_cast<float>(row);
      first[i] = row * width + column;
    }
    for (std::size_t i = 0; i < num; ++i) {
      const std::uint8_t* const p = pixels.data() + first[i];
      p00[i] = p[0];
      p01[i] = p[1];
      p10[i] = p[width];
      p11[i] = p[width + 1];
    }
    for (std::size_t i = 0; i < num; ++i) {
      const float upper = static_cast<float>(p00[i]) +
                          right[i] * static_cast<float>(p01[i] - p00[i]);
      const float lower = static_cast<float>(p10[i]) +
                          right[i] * static_cast<float>(p11[i] - p10[i]);
      values[begin + i] = upper + below[i] * (lower - upper);
    }
  }
}

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
