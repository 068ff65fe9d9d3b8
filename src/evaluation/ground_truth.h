// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Ground-truth curves as text.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <string_view>
#include <vector>

#include "synthetic/synthetic_scene.h"

namespace curvix {

// Samples, uniform along each curve and in order. What a file does not give is
// left at its default in the samples and marked here.
struct GroundTruth {
  std::vector<TrueSample> samples;
  bool has_tangents = true;
  bool has_curve_ids = true;
  bool has_views = true;   // num_views_seen and num_views_edge
  bool has_kinds = false;  // a sample at least with a kind
};

// Reads rows
//   x y z [tx ty tz [curve_id [num_views_seen [num_views_edge [kind]]]]]
// of 3 to 10 numbers, the same count in each row; '#' starts a comment. Without
// a ninth column num_views_edge is num_views_seen. The kind is the number of
// its CurveKind: 1 crease, 2 boundary, 3 marking, 4 occluding contour, 0
// unknown. kDataLoss for anything else, or if there is no row.
Result<GroundTruth> ParseGroundTruth(std::string_view text);
Result<GroundTruth> ReadGroundTruth(const std::filesystem::path& path);

}  // namespace curvix
