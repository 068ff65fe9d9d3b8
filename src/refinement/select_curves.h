// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Leaves out curves that the views hardly confirm.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>

#include <vector>

#include "model/posed_view.h"

namespace curvix {

// The curves, in order, whose median evidence is at least
//   min_evidence * max(1, (s / sigma_scale_px)^2),
// where s is their median sigma in pixels (pixel_size.h). One 3D edge can have
// its support by chance, or lie on the silhouette of a round body, which looks
// like a curve from directions in one plane and is badly determined; a whole
// curve of such edges is recognised more surely than each of them. Curves whose
// sigma is not known stay.
std::vector<Curve> SelectCurves(std::vector<Curve> curves,
                                const std::vector<PosedView>& views,
                                const CurveRefinementOptions& options);

}  // namespace curvix
