// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How well curves agree with images: a measure that
// needs no true curves.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <optional>
#include <vector>

#include "base/gray_image.h"

namespace curvix {

// A share, and how large it is after everything was moved by 12 pixels across,
// to either side: 0..1.
struct ShareAboveChance {
  double share = 0;
  double chance = 0;

  // What is above chance, of what can be: (share - chance) / (1 - chance); 0 if
  // chance is 1.
  double Lift() const {
    return chance < 1 ? (share - chance) / (1 - chance) : 0;
  }
};

// Curves and images. What is in an image is found by Canny's edges and
// LSD's lines, not by the edges that curves are made of. Hidden curves are not
// left out.
struct ImageAgreement {
  // Of the steps of 2 pixels that the projected curves take, each segment at
  // least one, those that lie on a contour: within 1.5 pixels and 15 degrees.
  ShareAboveChance precision;
  // The same of those samples only that should be seen: of the other views, the
  // two in most like direction support it. nullopt: there are none.
  std::optional<ShareAboveChance> expected_precision;
  // Of the strongest fifth of all contours, what lies within 2 pixels and 15
  // degrees of a curve.
  ShareAboveChance strong_contours;
  // Of the length of straight lines that are 2 % of the image's diagonal and
  // longer, what lies within 3 pixels and 10 degrees of a curve.
  ShareAboveChance long_lines;
  // Median length of a curve in an image. Pixels; 0 if there is none.
  double median_piece_px = 0;
};

// Compares curves of any origin with the images of `view_idxs`, by their
// image files. Fails if an image cannot be read.
Result<ImageAgreement> CompareWithImages(const std::vector<Curve>& curves,
                                         const Scene& scene,
                                         const std::vector<int>& view_idxs,
                                         int num_threads);

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
