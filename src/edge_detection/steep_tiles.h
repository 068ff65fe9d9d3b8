// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Flat parts of an image, in which nothing needs to
// be computed.
#pragma once

#include <cstddef>
#include <vector>

#include "base/gray_image.h"

namespace curvix {

// Pixels [begin, end) of a row.
struct PixelRun {
  int begin = 0;
  int end = 0;
};

// Which square tiles of an image are not flat. A tile is flat if its pixels and
// those of the eight tiles around it span at most `max_span` grey levels:
// whatever is computed from pixels no further than `reach_px` away sees no more
// contrast than that.
class SteepTiles {
 public:
  // reach_px >= 0. A negative `max_span` makes every tile steep.
  SteepTiles(const GrayImage& image, int reach_px, float max_span);

  // The pixels of row `y` that lie in steep tiles, in rising order; apart from
  // each other. 0 <= y < height.
  const std::vector<PixelRun>& Runs(int y) const {
    return runs_[static_cast<std::size_t>(y / side_)];
  }

 private:
  int side_;                                 // pixels
  std::vector<std::vector<PixelRun>> runs_;  // by row of tiles
};

}  // namespace curvix
