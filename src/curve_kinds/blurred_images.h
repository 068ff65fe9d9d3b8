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

  // Whether the image holds all places within `reach` of `pixel`, both in
  // pixels of the view's image, and one more pixel here around them.
  bool Covers(const Eigen::Vector2d& pixel, double reach) const {
    const Eigen::Vector2d at = pixel * scale_;
    const double margin = reach * scale_ + 1;
    return at.x() >= margin && at.y() >= margin && at.x() < width_ - margin &&
           at.y() < height_ - margin;
  }

  // Asks for the tiles with the pixels of `box`, which are all in the image.
  void AskFor(const Eigen::AlignedBox2i& box);
  // Whether any tile is asked for.
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
  // Row by row. Before Keep(): 1 if the tile is asked for, else 0. Afterwards:
  // where its pixels begin in `pixels_`; 0 also if it is not kept. Empty if no
  // tile is asked for.
  std::vector<int> tiles_;
  std::vector<std::uint8_t> pixels_;
};

// One per view, in order, of no tiles yet; of no pixels where there is no image
// to read (CheckImage). If all of them would have more than 2^30 pixels, the
// width and height of each are halved until they have not.
std::vector<BlurredImage> PlanBlurredImages(const Scene& scene,
                                            int num_threads);

// Reads the tiles asked for. An image that turns out to be broken has no pixels
// then, and places that chose it have one view fewer.
void ReadTiles(const Scene& scene,
               int num_threads,
               std::vector<BlurredImage>* images);

}  // namespace curvix
