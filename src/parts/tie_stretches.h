// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which ends of the curves of parts belong together.
#pragma once

#include <curvix/options.h>
#include <curvix/parts.h>

#include <cstddef>
#include <vector>

#include "model/end_chains.h"
#include "parts/border_samples.h"
#include "parts/runs.h"

namespace curvix {

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
// (twin_samples.h), so that pieces fall into stretches. Beyond its end, a
// stretch goes on as its part has drawn it: the first sample there that has a
// twin that stays leads to the stretch to which it is tied; the nearest first.
TiedStretches TieStretches(const ScenePartition& partition,
                           const std::vector<Piece>& pieces,
                           const ConnectivityOptions& options);

}  // namespace curvix
