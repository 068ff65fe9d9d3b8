// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Places that several parts have drawn.
#pragma once

#include <curvix/options.h>
#include <curvix/parts.h>

#include <cstddef>
#include <vector>

#include "parts/border_samples.h"

namespace curvix {

// A border sample of a piece.
struct SampleRef {
  std::size_t piece = 0;
  std::size_t border_sample = 0;  // index into Piece::border_samples
};

// For border samples, the nearest sample in each other part that is the same
// place on the same curve: at most options.max_normal_distance_px away and
// max_angle_deg off in direction. Ties: the earlier sample.
class TwinSamples {
 public:
  // Partition and pieces outlive it.
  TwinSamples(const ScenePartition& partition,
              const std::vector<Piece>& pieces,
              const ConnectivityOptions& options);

  // In the order of the parts.
  const std::vector<SampleRef>& Of(const SampleRef& ref) const {
    return twins_[ref.piece][ref.border_sample];
  }

  // Whether, of a sample and its twins, it is the one that stays: that of the
  // part that owns the place where the first of their parts has put it; if
  // that part has none, that of the first.
  bool Stays(const SampleRef& ref) const;

 private:
  const ScenePartition& partition_;
  const std::vector<Piece>& pieces_;
  // Of each border sample of each piece.
  std::vector<std::vector<std::vector<SampleRef>>> twins_;
};

}  // namespace curvix
