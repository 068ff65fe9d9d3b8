// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Places that several parts have drawn, and which
// ends of their curves belong together.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "model/curve_chains.h"
#include "model/posed_view.h"
#include "model/sample_runs.h"
#include "parts/regions.h"
#include "parts/scene_parts.h"

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

// A border sample of a piece.
struct SampleRef {
  std::size_t piece = 0;
  std::size_t border_sample = 0;  // index into Piece::border_samples
};

// For border samples, the nearest sample in each other part that is the same
// place on the same curve: at most options.max_normal_distance_px away and
// max_angle_deg off in direction. Ties: the earlier sample.
class DuplicateSamples {
 public:
  // Partition and pieces outlive it.
  DuplicateSamples(const ScenePartition& partition,
                   const std::vector<Piece>& pieces,
                   const ConnectivityOptions& options);

  // In the order of the parts.
  const std::vector<SampleRef>& Of(const SampleRef& ref) const {
    return duplicates_[ref.piece][ref.border_sample];
  }

  // Whether, of a sample and its duplicates, it is the one that stays: that of
  // the part that owns the place where the first of their parts has put it; if
  // that part has none, that of the first.
  bool Stays(const SampleRef& ref) const;

 private:
  const ScenePartition& partition_;
  const std::vector<Piece>& pieces_;
  // Of each border sample of each piece.
  std::vector<std::vector<std::vector<SampleRef>>> duplicates_;
};

// Samples of a piece that stay.
struct Stretch {
  std::size_t piece = 0;
  Run run;
};

// In the order of the pieces, and how their ends go on.
struct TiedStretches {
  std::vector<Stretch> stretches;
  EndTies ties;
};

// Of the samples that several parts have of one place, one stays
// (DuplicateSamples), so that pieces fall into stretches. Beyond its end, a
// stretch goes on as its part has drawn it: the first sample there that has a
// duplicate that stays leads to the stretch to which it is tied; the nearest
// first.
TiedStretches TieStretches(const ScenePartition& partition,
                           const std::vector<Piece>& pieces,
                           const ConnectivityOptions& options);

}  // namespace curvix
