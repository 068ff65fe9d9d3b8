// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves across the borders of parts.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <cstddef>
#include <vector>

#include "model/curve_chains.h"
#include "model/posed_view.h"
#include "parts/scene_parts.h"
#include "parts/tie_curves.h"

namespace curvix {

// The curves of JoinParts() in scene_parts.h, for posed views. The constructor
// holds the border samples (tie_curves.h) in memory; afterwards there are a
// table of segments, and one curve while it is shown.
//
// Tied segments (TieSegments) become one curve. First samples of the next
// segment that would step back are dropped.
class JoinedCurves final : public CurveSource {
 public:
  // Reads each curve twice. Partition and parts outlive it.
  JoinedCurves(const ScenePartition& partition,
               PartResults& parts,
               std::vector<PosedView> views,
               const Options& options);

  std::size_t size() const override { return chains_.size(); }
  void ForEach(const Visit& visit) const override;
  Edge2d EdgeOf(const EdgeRef& ref) const override {
    return edges_.at(static_cast<std::size_t>(ref.edge_idx));
  }
  Status status() const override { return status_; }

 private:
  Result<TracedCurve> Read(int part_idx, std::size_t curve_idx) const;
  Result<TracedCurve> Join(const EndChain& chain) const;
  std::vector<PartCurve> ReadPartCurves() const;
  void DropLooseShortCurves(double min_length_px);

  const ScenePartition& partition_;
  PartResults& parts_;
  std::vector<PosedView> views_;
  std::vector<PartCurve> part_curves_;  // without border samples
  TiedSegments tied_;
  std::vector<EndChain> chains_;  // one per curve
  mutable Status status_;
  mutable std::vector<Edge2d> edges_;  // of the curve that is shown
};

}  // namespace curvix
