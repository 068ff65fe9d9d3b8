// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Stretches of curves that lead to a place on them.
#pragma once

#include <curvix/curves.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace curvix {

// Where on a curve a stretch lies, from the sample to which it leads.
struct ArmStretch {
  double skipped = 0;  // of what is nearest to it; arc lengths, world units
  double length = 0;   // of what comes before
};

// The samples of `curve` that lead to sample `last` in the direction of the
// curve, or against it, tangents turned; the one nearest to `last` comes last.
// Open; of a closed curve at most half; empty if it does not reach so far.
Curve ArmTo(const Curve& curve,
            std::size_t last,
            bool with_direction,
            const ArmStretch& stretch);

// How far the samples of two arms that lead to each other are from the parabola
// that fits both best, root mean square, world units. Neither may be empty, nor
// may they end in one place.
double DistanceFromParabola(const Curve& from, const Curve& to);

// Cuts the last samples of an end off, up to the one nearest to it that `keep`
// is true for; two stay.
template <typename Keep>
void CutEnd(Curve& curve, bool front, const Keep& keep) {
  std::vector<CurveSample>& samples = curve.samples;
  if (!front) std::reverse(samples.begin(), samples.end());
  while (samples.size() > 2 && !keep(samples.back())) samples.pop_back();
  if (!front) std::reverse(samples.begin(), samples.end());
}

}  // namespace curvix
