// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves across the borders of parts.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstddef>
#include <vector>

#include "model/curve_chains.h"
#include "model/posed_view.h"
#include "parts/scene_parts.h"
#include "parts/tie_curves.h"

namespace curvix {

// The curves of the scene. They read those of `parts` again whenever they are
// shown; partition and parts must outlive them. In memory are only a table of
// the curves and the one that is shown; while they are joined, also positions
// and directions of samples near borders (tie_curves.h).
//
// Of duplicates in several parts, that of the part whose core holds it stays.
// Ends at borders are joined to their continuation in another part
// (TieSegments), without its first samples if they would step back. Curves come
// in the order of the parts and of the curves in them, by their first piece.
// Joined curves shorter than options.curve_refinement.min_length_px go, unless
// they join two junctions. status() is the first error of `parts`, or kDataLoss
// if a curve names views or edges that are not there.
class JoinedCurves final : public CurveSource {
 public:
  // Reads each curve twice or more.
  JoinedCurves(const ScenePartition& partition,
               PartResults& parts,
               const Scene& scene,
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
