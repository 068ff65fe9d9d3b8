// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves against the contours that one image shows.
#pragma once

#include <curvix/edges.h>
#include <vector>

#include "edge_detection/gray_image.h"
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

// The pixels of contours: Canny's edges with the strongest tenth of all
// gradients, but at least 4 grey levels per pixel, as upper threshold and half
// of it as the lower one, in connected pieces of 30 pixels or more. Positions
// are centres of pixels, angles those of the contour, strengths the gradient in
// grey levels per pixel; row by row.
std::vector<Edge2d> FindContours(const GrayImage& image);

// Long straight lines (LSD), 2 % of the image's diagonal and longer, as places
// one pixel apart with the angle of their line.
std::vector<Edge2d> FindLongLines(const GrayImage& image);

}  // namespace curvix
