// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/blurred_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/angles.h"
#include "base/check.h"
#include "base/median.h"
#include "base/parallel.h"
#include "base/wide_vectors.h"
#include "edge_detection/load_image.h"

namespace curvix {
namespace {

// Of all images together, so that what is kept of them is bounded.
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 30;
// Against noise and aliasing.
constexpr double kBlurPx = 0.7;

// Pixels of the side of a tile, a power of two. Its first neighbours on the
// right and below are kept with it, so that all that is interpolated is in one.
constexpr int kTile = 16;
constexpr int kStride = kTile + 1;

std::int64_t NumPixels(const Scene& scene, int shrink) {
  std::int64_t pixels = 0;
  for (const View& view : scene.views) {
    const Camera& camera = CameraOf(scene, view);
    pixels += static_cast<std::int64_t>(camera.width / shrink) *
              (camera.height / shrink);
  }
  return pixels;
}

// The standard deviation of white noise, grey levels, by Immerkaer's (1996)
// mask, to which texture coarser than a few pixels hardly counts. It is small
// in JPEG images, which lose such noise.
double FineNoise(const GrayImage& gray) {
  constexpr int kStep = 3;
  std::vector<double> responses;
  responses.reserve(gray.pixels.size() / (kStep * kStep));
  for (int y = 1; y + 1 < gray.height; y += kStep) {
    for (int x = 1; x + 1 < gray.width; x += kStep) {
      const auto row = [&](int v) {
        return gray.at(x - 1, v) - 2 * gray.at(x, v) + gray.at(x + 1, v);
      };
      const float response = row(y - 1) - 2 * row(y) + row(y + 1);
      responses.push_back(std::abs(static_cast<double>(response)) / 6);
    }
  }
  return kSigmasPerMedian * MedianOr(0, std::move(responses));
}

// Blurs the whole image and keeps the tiles asked for.
void KeepTiles(GrayImage gray, BlurredImage* kept) {
  const double noise = FineNoise(gray);
  const int shrink = static_cast<int>(std::lround(1 / kept->scale()));
  cv::Mat image(gray.height, gray.width, CV_32F, gray.pixels.data());
  if (shrink > 1) {
    // Whole blocks only, so that the scale is exact.
    const cv::Rect whole(0, 0, kept->width() * shrink, kept->height() * shrink);
    cv::Mat small;
    cv::resize(image(whole),
               small,
               cv::Size(kept->width(), kept->height()),
               0,
               0,
               cv::INTER_AREA);
    image = small;
  }
  // Of white noise, the sum of the squared weights is left.
  const double gain = 1 / (4 * kPi * kBlurPx * kBlurPx) / (shrink * shrink);
  cv::Mat blurred;
  cv::GaussianBlur(image, blurred, cv::Size(), kBlurPx);
  std::vector<std::uint8_t> pixels(blurred.total());
  blurred.convertTo(cv::Mat(blurred.size(), CV_8U, pixels.data()), CV_8U);
  kept->Keep(pixels, gain * noise * noise);
}

}  // namespace

BlurredImage::BlurredImage(int width, int height, double scale)
    : width_(width), height_(height), scale_(scale) {}

int BlurredImage::TilesPerRow() const { return (width_ - 1) / kTile + 1; }

void BlurredImage::AskFor(const Eigen::AlignedBox2i& box) {
  if (tiles_.empty()) {
    tiles_.resize(static_cast<std::size_t>(TilesPerRow()) *
                  static_cast<std::size_t>((height_ - 1) / kTile + 1));
  }
  CURVIX_CHECK(box.min().minCoeff() >= 0 && box.max().x() < width_ &&
                   box.max().y() < height_,
               "box up to " << box.max().transpose());
  const Eigen::Vector2i first = box.min() / kTile;
  const Eigen::Vector2i last = box.max() / kTile;
  for (int row = first.y(); row <= last.y(); ++row) {
    for (int column = first.x(); column <= last.x(); ++column) {
      tiles_[static_cast<std::size_t>(row * TilesPerRow() + column)] = 1;
    }
  }
}

void BlurredImage::Keep(std::span<const std::uint8_t> pixels,
                        double noise_variance) {
  CURVIX_CHECK(pixels.size() == static_cast<std::size_t>(width_) *
                                    static_cast<std::size_t>(height_),
               pixels.size() << " pixels");
  noise_variance_ = noise_variance;
  const auto num = std::ranges::count(tiles_, 1);
  pixels_.resize(static_cast<std::size_t>(num * kStride * kStride));
  int end = 0;
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    if (tiles_[tile] == 0) continue;
    tiles_[tile] = end;
    const int left = static_cast<int>(tile) % TilesPerRow() * kTile;
    const int top = static_cast<int>(tile) / TilesPerRow() * kTile;
    for (int row = 0; row < std::min(kStride, height_ - top); ++row) {
      std::copy_n(pixels.data() + (top + row) * width_ + left,
                  std::min(kStride, width_ - left),
                  pixels_.data() + end + row * kStride);
    }
    end += kStride * kStride;
  }
}

// In blocks, each in three loops: the first and the last are vectorised, the
// one that reads pixels cannot be.
CURVIX_WIDE_VECTORS
void BlurredImage::LookUp(std::span<const float> x,
                          std::span<const float> y,
                          float* values) const {
  constexpr std::size_t kBlock = 64;
  std::array<int, kBlock> tile, first, p00, p01, p10, p11;
  std::array<float, kBlock> right, below;
  const int tiles_per_row = TilesPerRow();
  for (std::size_t begin = 0; begin < x.size(); begin += kBlock) {
    const std::size_t num = std::min(kBlock, x.size() - begin);
    for (std::size_t i = 0; i < num; ++i) {
      const int column = std::min(static_cast<int>(x[begin + i]), width_ - 2);
      const int row = std::min(static_cast<int>(y[begin + i]), height_ - 2);
      right[i] = x[begin + i] - static_cast<float>(column);
      below[i] = y[begin + i] - static_cast<float>(row);
      tile[i] = row / kTile * tiles_per_row + column / kTile;
      first[i] = row % kTile * kStride + column % kTile;
    }
    for (std::size_t i = 0; i < num; ++i) {
      const std::uint8_t* const p =
          pixels_.data() + tiles_[static_cast<std::size_t>(tile[i])] + first[i];
      p00[i] = p[0];
      p01[i] = p[1];
      p10[i] = p[kStride];
      p11[i] = p[kStride + 1];
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

std::vector<BlurredImage> PlanBlurredImages(const Scene& scene,
                                            int num_threads) {
  int shrink = 1;
  while (NumPixels(scene, shrink) > kMaxPixels) shrink *= 2;
  std::vector<BlurredImage> images(scene.views.size());
  ParallelFor(images.size(), num_threads, [&](std::size_t i) {
    const Camera& camera = CameraOf(scene, scene.views[i]);
    const bool is_there = CheckImage(scene.views[i], camera).ok();
    images[i] = BlurredImage(is_there ? camera.width / shrink : 0,
                             is_there ? camera.height / shrink : 0,
                             1.0 / shrink);
  });
  return images;
}

void ReadTiles(const Scene& scene,
               int num_threads,
               std::vector<BlurredImage>* images) {
  ParallelFor(images->size(), num_threads, [&](std::size_t i) {
    BlurredImage& image = (*images)[i];
    if (!image.IsAskedFor()) return;
    auto gray = LoadGrayImage(scene.views[i], CameraOf(scene, scene.views[i]));
    if (gray.ok()) {
      KeepTiles(*std::move(gray), &image);
    } else {
      image = BlurredImage(0, 0, image.scale());
    }
  });
}

}  // namespace curvix
