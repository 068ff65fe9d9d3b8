// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves against what one photograph shows.
#pragma once

#include <curvix/edges.h>
#include <curvix/holdout.h>

#include <cstdint>
#include <vector>

namespace curvix {

// Places that were looked at, and those that had a counterpart. Chance is
// counted twice, for moves to both sides. Sums do not depend on the order.
struct ShareTally {
  std::int64_t num = 0;
  std::int64_t num_hits = 0;
  double num_by_chance = 0;

  void Add(const ShareTally& other);
  ShareAboveChance Summarize() const;
};

// A curve in a photograph: places no more than 2 pixels apart, with the angle
// of the curve.
struct DrawnCurve {
  std::vector<Edge2d> places;
  std::vector<bool> is_expected;  // one per place: it should be seen
  double length_px = 0;           // > 0
};

struct PhotographTally {
  ShareTally precision;
  ShareTally expected_precision;
  ShareTally strong_contours;
  ShareTally long_lines;
  std::vector<double> pieces_px;  // lengths of the curves

  void Add(const PhotographTally& other);
  PhotographAgreement Summarize() const;
};

// `contours` and `long_lines`: FindContours() and FindLongLines() of the
// photograph.
PhotographTally CompareWithPhotograph(const std::vector<DrawnCurve>& drawn,
                                      const std::vector<Edge2d>& contours,
                                      const std::vector<Edge2d>& long_lines);

}  // namespace curvix
