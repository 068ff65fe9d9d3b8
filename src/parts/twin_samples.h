// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Places that several parts have drawn.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <curvix/parts.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// A curve of a part.
struct Piece {
  int part_idx = 0;
  Curve curve;
};

struct SampleRef {
  std::size_t piece = 0;
  std::size_t sample = 0;
};

// For the samples near borders, the nearest sample in each other part that is
// the same place on the same curve: at most options.max_normal_distance_px away
// and max_angle_deg off in direction. Ties: the earlier sample.
class TwinSamples {
 public:
  TwinSamples(const ScenePartition& partition,
              const std::vector<Piece>& pieces,
              const std::vector<PosedView>& views,
              const ConnectivityOptions& options);

  // In the order of the parts.
  const std::vector<SampleRef>& Of(const SampleRef& ref) const;

  // Whether, of a sample and its twins, it is the one that stays: that of the
  // part that owns the place where the first of their parts has put it; if
  // that part has none, that of the first.
  bool Stays(const SampleRef& ref) const;

 private:
  const ScenePartition& partition_;
  const std::vector<Piece>& pieces_;
  // Of each sample of each piece, an index into twins_, whose first is empty.
  std::vector<std::vector<std::uint32_t>> twin_idxs_;
  std::vector<std::vector<SampleRef>> twins_;
};

}  // namespace curvix
