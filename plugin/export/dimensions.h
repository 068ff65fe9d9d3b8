// SPDX-License-Identifier: BSD-3-Clause
// dimensions.csv: lengths, radii, distances and angles of what matters most.
#pragma once

#include "plugin/export/curves_json.h"

namespace curvix {

// A table of docs/measuring.md: the 100 longest lines; the 100 largest circles
// and, where these are fewer, arcs that are a curve by themselves; between the
// 15 longest lines, angles and the distances of parallel ones; between the 15
// largest circles, and between the 15 nodes with the best known positions that
// lie furthest apart, distances. Ties go to the smaller index. Lines and arcs
// of no length are left out. Standard deviations include that of the scale.
void EncodeDimensions(const CurveRecord& record, const ByteSink& sink);

}  // namespace curvix
