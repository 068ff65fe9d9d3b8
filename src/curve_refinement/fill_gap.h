// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves where edges are missing.
#pragma once

#include <curvix/curves.h>
#include <vector>

#include "curve_refinement/image_support.h"
#include "model/curve_chains.h"
#include "model/posed_view.h"

namespace curvix {

// StringTogether (curve_chains.h) with samples in each gap on the cubic that
// passes those at both ends with their tangents, about 1.5 px apart. Sigma and
// evidence are those of the weaker of both; support is what `images` have
// within 1 px.
std::vector<Curve> StringTogetherFilled(std::vector<Curve> curves,
                                        const EndTies& ties,
                                        const std::vector<PosedView>& views,
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
