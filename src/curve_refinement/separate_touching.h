// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves that touch each other.
#pragma once

#include <curvix/curves.h>
#include <cstddef>
#include <vector>

#include "curve_refinement/image_support.h"
#include "model/curve_chains.h"
#include "model/posed_view.h"

namespace curvix {

// The last pixels before an end, which may be bent, tell nothing.
inline constexpr double kBentEndPx = 3;

// Two open ends and a curve that runs past `a` and then past `b`.
struct Meeting {
  EndIdx a = 0;
  EndIdx b = 0;
  std::size_t passing_idx = 0;
  std::size_t sample_at_a = 0;  // of the passing curve
  std::size_t sample_at_b = 0;
  // Whether the curve that ends in `a` goes on as the passing one behind `b`,
  // and that before `a` as the one that ends in `b`. Otherwise `a` and `b`
  // belong together.
  bool exchange = false;
  double rms_px = 0;  // of the samples from the parabolas
};

// Ends that face each other, at most 100 px apart, and curves that pass both
// within 8 px and 30 degrees. Parabolas through 15 to 60 px of the four
// branches tell which belong together: `a` and `b`, or, unless the passing
// curve is closed, those that are exchanged, if their distances are below 0.6
// times the others. They must fit to 0.4 px, and the images show what is
// between the branches (fill_gap.h). Best fits first; ties by the order of
// curves. Pixels as in pixel_size.h.
std::vector<Meeting> FindMeetings(const std::vector<Curve>& curves,
                                  const std::vector<PosedView>& views,
                                  const ImageSupport& images);

// Where two curves touch, the shared segment is traced once: one curve breaks,
// or the two are swapped behind it. Wherever two ends meet beside a passing
// curve (FindMeetings), both curves are carried on through what they share,
// exchanged if need be: the last 3 px before the ends are cut off, and gaps are
// filled (fill_gap.h).
std::vector<Curve> SeparateTouching(std::vector<Curve> curves,
                                    const std::vector<PosedView>& views,
                                    const ImageSupport& images);

}  // namespace curvix
