// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves against views that had no part in them.
#pragma once

#include <curvix/curves.h>
#include <curvix/holdout.h>

#include <vector>

#include "model/posed_view.h"

namespace curvix {

struct HoldoutAgreements {
  HoldoutAgreement all;
  HoldoutAgreement expected;
};

// `is_held_out`, `edge_maps`: one per view. A sample behind a view or outside
// its image does not count there. Views in equally like direction: the smaller
// index comes first.
HoldoutAgreements MeasureAgreement(const std::vector<Curve>& curves,
                                   const std::vector<PosedView>& views,
                                   const std::vector<EdgeMap>& edge_maps,
                                   const std::vector<bool>& is_held_out,
                                   const HoldoutOptions& options,
                                   int num_threads);

}  // namespace curvix
