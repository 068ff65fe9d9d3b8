// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves against what one image shows.
#pragma once

#include <curvix/edges.h>
#include <vector>

#include "evaluation/holdout.h"

namespace curvix {

// How much was looked at, how much of it had a counterpart, and how much after
// it was moved, the mean of both sides.
struct ShareTally {
  double amount = 0;
  double hits = 0;
  double hits_by_chance = 0;

  void Add(const ShareTally& other);
  ShareAboveChance Summarize() const;
};

// A segment of at most 2 pixels of a curve in an image: its middle, with the
// angle of the curve.
struct DrawnPlace {
  Edge2d edge;
  double length_px = 0;  // > 0
  // What it counts: of the steps of 2 pixels that its segment takes, its share.
  // A segment shorter than 2 pixels is one step.
  double num_steps = 1;
  bool is_expected = false;  // it should be seen
};

using DrawnCurve = std::vector<DrawnPlace>;

struct ImageTally {
  ShareTally precision;
  ShareTally expected_precision;
  ShareTally strong_contours;
  ShareTally long_lines;
  std::vector<double> pieces_px;  // lengths of the curves

  void Add(const ImageTally& other);
  ImageAgreement Summarize() const;
};

// `contours` and `long_lines`: FindContours() and FindLongLines() of the
// image.
ImageTally CompareWithImage(const std::vector<DrawnCurve>& drawn,
                            const std::vector<Edge2d>& contours,
                            const std::vector<Edge2d>& long_lines);

}  // namespace curvix
