// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What must be known of the curves of all parts at
// once.
#pragma once

#include <curvix/curves.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "model/posed_view.h"
#include "parts/regions.h"

namespace curvix {

// A sample of a piece that another part may have drawn, too.
struct BorderSample {
  std::size_t sample = 0;                              // of the piece
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  // unit
  double pixel = 0;  // PixelSize there, world units
};

// A curve of a part.
struct Piece {
  int part_idx = 0;
  std::size_t curve_idx = 0;  // in its part
  std::size_t num_samples = 0;
  bool closed = false;
  bool is_occluding_contour = false;
  std::vector<BorderSample> border_samples;  // ascending
};

// `core`: of the part. Border samples are those within `overlap` on either side
// of a border.
Piece MakePiece(int part_idx,
                std::size_t curve_idx,
                const Curve& curve,
                const std::vector<Border>& core,
                double overlap,
                const std::vector<PosedView>& views);

}  // namespace curvix
