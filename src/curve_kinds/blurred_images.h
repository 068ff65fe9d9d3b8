// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Where grey levels of images are looked up: the parts
// of them that are asked for, kept small.
#pragma once

#include <curvix/scene.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace curvix {

// An image, slightly blurred and perhaps of reduced size, in 8 bits, of which
// only some square tiles are kept.
class BlurredImage {
 public:
  BlurredImage() = default;  // of no pixels
  BlurredImage(int width, int height, double scale);

  int width() const { return width_; }
  int height() const { return height_; }
  // Pixels here per pixel of the view's image, in (0, 1].
  double scale() const { return scale_; }

  // Whether all within `reach` pixels of `pixel` and one pixel here around it
  // is in the image. Both are of the view's image.
  bool Covers(const Eigen::Vector2d& pixel, double reach) const {
    const Eigen::Vector2d at = pixel * scale_;
    const double margin = reach * scale_ + 1;
    return at.x() >= margin && at.y() >= margin && at.x() < width_ - margin &&
           at.y() < height_ - margin;
  }

  // Asks for the tiles with the pixels of `box`, which are all in the image.
  void AskFor(const Eigen::AlignedBox2i& box);
  // Whether any tile is.
  bool IsAskedFor() const { return !tiles_.empty(); }
  // Keeps the tiles asked for. All `pixels` are given, row by row.
  void Keep(std::span<const std::uint8_t> pixels, double noise_variance);

  std::size_t NumKept() const { return pixels_.size(); }  // pixels

  // Of the pixels, squared grey levels.
  double noise_variance() const { return noise_variance_; }
  // Grey levels, 0..255, bilinear, at (x[i], y[i]) in pixels here, of which the
  // first has its centre at (0, 0): in boxes asked for, and from 0 to width - 1
  // and height - 1. Of at least two pixels either way. As many `values` as `x`
  // and `y`.
  void LookUp(std::span<const float> x,
              std::span<const float> y,
              float* values) const;

 private:
  int TilesPerRow() const;

  int width_ = 0;
  int height_ = 0;
  double scale_ = 1;
  double noise_variance_ = 0;
  // Row by row, where the pixels of each begin; before Keep(), 1 if it is asked
  // for, else 0. Empty if none are.
  std::vector<int> tiles_;
  std::vector<std::uint8_t> pixels_;
};

// One per view, in order, of no tiles yet; of no pixels where there is no image
// to read (CheckImage). If all of them would have more than 2^30 pixels, the
// width and height of each are halved until they have not.
std::vector<BlurredImage> PlanBlurredImages(const Scene& scene,
                                            int num_threads);

// Reads the tiles asked for. An image that turns out to be broken has no pixels
// then, so places that chose it have a view fewer.
void ReadTiles(const Scene& scene,
               int num_threads,
               std::vector<BlurredImage>* images);

}  // namespace curvix
