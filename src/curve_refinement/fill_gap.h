// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves where edges are missing.
#pragma once

#include <curvix/curves.h>
#include <cstddef>
#include <vector>

#include "curve_refinement/image_support.h"
#include "model/curve_chains.h"
#include "model/posed_view.h"

namespace curvix {

// The samples between two others on the cubic that passes both with their
// tangents, about 1.5 px apart; `pixel` in world units. Sigma and evidence are
// those of the weaker of both; support is what `images` have within 1 px.
std::vector<CurveSample> SamplesBetween(const CurveSample& from,
                                        const CurveSample& to,
                                        double pixel,
                                        const ImageSupport& images);

// StringTogether (curve_chains.h) with such samples in the gaps.
std::vector<Curve> StringTogetherFilled(std::vector<Curve> curves,
                                        const EndTies& ties,
                                        const std::vector<PosedView>& views,
                                        const ImageSupport& images);

// The median number of 2D edges of the last samples before an end.
std::size_t SupportBefore(const Curve& curve, bool front);

// Whether four fifths of the samples have at least half of `usual` 2D edges.
bool AreShown(const std::vector<CurveSample>& filled, std::size_t usual);

}  // namespace curvix
