// SPDX-License-Identifier: BSD-3-Clause
// Curves as a COLMAP model whose points are their samples.
#pragma once

#include "colmap/colmap_model.h"
#include "plugin/export/curves_json.h"

namespace curvix {

// The cameras and poses of the scene; every sample of a curve with support in
// two views or more is a point, numbered from 1, curve after curve, with the
// colour of its curve, its mean reprojection error, and a track through the
// edges that support it, which are the 2D points of the images. For COLMAP, and
// for programs that start from its points.
ColmapModel CurvesAsPoints(const CurveRecord& record);

}  // namespace curvix
