// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "parts/border_samples.h"

#include "geometry/pixel_size.h"

namespace curvix {

Piece MakePiece(int part_idx,
                std::size_t curve_idx,
                const Curve& curve,
                const std::vector<Border>& core,
                double overlap,
                const std::vector<PosedView>& views) {
  Piece piece{part_idx,
              curve_idx,
              curve.samples.size(),
              curve.closed,
              curve.is_occluding_contour,
              {}};
  for (std::size_t k = 0; k < curve.samples.size(); ++k) {
    const CurveSample& sample = curve.samples[k];
    if (DistanceBeyond(core, sample.position) < -overlap) continue;
    piece.border_samples.push_back(
        {k,
         sample.position,
         sample.tangent,
         PixelSize(sample.position, sample.support, views)});
  }
  return piece;
}

}  // namespace curvix
