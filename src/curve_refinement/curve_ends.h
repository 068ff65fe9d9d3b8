// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The neighbourhood of a sample on its curve, the
// curve up to it, how a curve goes on beyond its end, and what fills gaps.
#pragma once

#include <curvix/curves.h>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "curve_refinement/image_support.h"
#include "model/curve_chains.h"
#include "model/posed_view.h"

namespace curvix {

// Blur rounds a corner so far along either of its curves.
constexpr double kRoundedPx = 2.5;

// The last pixels before an end, which may be bent, tell nothing.
constexpr double kBentEndPx = 3;

// Bandwidths to which Gaussian weights along a curve reach.
constexpr double kKernelReach = 3;

struct SampleAround {
  std::size_t index = 0;
  double along = 0;  // arc length from the sample asked for, signed
};

// The sample `index` itself first, then those after it and those before it
// within `reach` (world units) along the curve; of a closed curve at most half
// of it either way.
std::vector<SampleAround> SamplesAround(const Curve& curve,
                                        std::size_t index,
                                        double reach);

// Where on a curve a segment lies, from the sample to which it leads.
struct BranchSegment {
  double skipped = 0;  // of what is nearest to it; arc lengths, world units
  double length = 0;   // of what comes before
};

// The samples of `curve` that lead to sample `last` in the direction of the
// curve, or against it, tangents turned; the one nearest to `last` comes last.
// Open; of a closed curve at most half; empty if it does not reach so far.
Curve BranchTo(const Curve& curve,
               std::size_t last,
               bool with_direction,
               const BranchSegment& segment);

// How far the samples of two branches that lead to each other are from the
// parabola that fits both best, root mean square, world units. Neither may be
// empty, nor may they end in one place.
double DistanceFromParabola(const Curve& from, const Curve& to);

// Cuts the last samples of an end off, up to the one nearest to it that `keep`
// is true for; two stay.
template <typename Keep>
void CutEnd(Curve& curve, bool at_head, const Keep& keep) {
  std::vector<CurveSample>& samples = curve.samples;
  if (!at_head) std::ranges::reverse(samples);
  while (samples.size() > 2 && !keep(samples.back())) samples.pop_back();
  if (!at_head) std::ranges::reverse(samples);
}

// A segment of a curve before one of its ends, in pixels (pixel_size.h) from
// the last sample.
struct EndSegment {
  double begin_px = 0;  // samples nearer to the end are left out
  double end_px = 15;
};

// A line or an arc through the last samples of a curve. Arc lengths count from
// the point nearest to the last sample, on beyond the end.
struct EndFit {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // at arc length 0
  Eigen::Vector3d outward = Eigen::Vector3d::UnitX();  // unit, out of the curve
  Eigen::Vector3d bend = Eigen::Vector3d::Zero();  // 1 / radius, to the centre
  double length = 0;  // of the fitted samples, world units; 0: no fit
  double rms = 0;     // distance of the samples, world units
  double pixel = 0;   // world units

  Eigen::Vector3d PointAt(double arc_length) const;
  Eigen::Vector3d DirectionAt(double arc_length) const;  // unit
  // Of the point nearest to `point`, at most a quarter of a turn off.
  double ArcLengthTo(const Eigen::Vector3d& point) const;
};

// Fits the samples in `segment`, few outliers aside, by a line, or by an arc of
// any radius where it comes nearer to them than their scatter explains; length
// is 0 if they are fewer than four or of no extent, or the curve is closed.
EndFit FitEnd(const Curve& curve,
              bool at_head,
              const EndSegment& segment,
              const std::vector<PosedView>& views);

// How a curve goes on right beyond its end: the fit to the last 8, 12 or 20 px,
// without the last `skipped_px`; the longest that fits to 0.06 px or about as
// well as the shortest, since what a longer one leaves over is a change of
// bend. `cut_px` of these pixels are cut off the curve already.
EndFit FitNearEnd(const Curve& curve,
                  bool at_head,
                  double skipped_px,
                  double cut_px,
                  const std::vector<PosedView>& views);

// The fit to the last 15, 25, 40 or 60 px, the last three of them aside, which
// corners bend: the longest that fits to 0.25 px or about as well as the first.
EndFit FitLongEnd(const Curve& curve,
                  bool at_head,
                  const std::vector<PosedView>& views);

// StringTogether (curve_chains.h) with samples in each gap on the cubic that
// passes those at both ends with their tangents, about 1.5 px apart. Sigma and
// evidence are those of the weaker of both; support is what `images` have
// within 1 px.
std::vector<Curve> StringTogetherFilled(std::vector<Curve> curves,
                                        const EndTies& ties,
                                        const ImageSupport& images);

// The median number of 2D edges of the last samples before an end, of those
// that have any; 0 if none has.
double SupportBefore(const Curve& curve, bool at_head);

// Whether four fifths of the samples in such a gap have at least half of
// `usual` 2D edges, and one. `pixel`: its size, world units.
bool IsGapShown(const CurveSample& from,
                const CurveSample& to,
                double pixel,
                double usual,
                const ImageSupport& images);

}  // namespace curvix
