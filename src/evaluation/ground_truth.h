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
  bool has_kinds = false;  // the file gives them, be they unknown
};

// Reads rows
//   x y z [tx ty tz [curve_id [num_views_seen [num_views_edge [kind]]]]]
// of 3 or 6 to 10 numbers, the same count in each row; '#' starts a comment.
// Without a ninth column num_views_edge is num_views_seen. The kind is the
// number of its CurveKind: 1 crease, 2 boundary, 3 marking, 4 occluding
// contour, 0 unknown. kDataLoss for anything else, or if there is no row.
Result<GroundTruth> ParseGroundTruth(std::string_view text);

// Gives the samples of `truth` the kinds of their curves, from rows
//   curve_id kind ...
// where the kind is a KindName; other words, as those of coarser classes, and
// curves without a row are of unknown kind. '#' starts a comment. kDataLoss for
// anything else, or if the truth has no curve ids.
Status ParseCurveKinds(std::string_view text, GroundTruth& truth);

// Reads both: `path`, and for a/gt.txt without kinds also a/gt_class.txt, if it
// exists.
Result<GroundTruth> ReadGroundTruth(const std::filesystem::path& path);

}  // namespace curvix
