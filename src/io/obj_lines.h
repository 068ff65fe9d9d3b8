// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Line sets as Wavefront OBJ;
// docs/output_format.md.
#pragma once

#include <curvix/curves.h>
#include <curvix/status.h>
#include <string_view>

#include "base/file_io.h"

namespace curvix {

// Per curve `o curve_<id>`, `v x y z r g b` per sample (colours in 0..1) and
// `l a b` per segment, the closing one last. Segments and not polylines:
// Blender and MeshLab show only the first segment of a longer `l`.
void EncodeObjLines(const CurveSource& curves, const ByteSink& sink);

// The curves of any OBJ with `v` and `l` (also `l` of many vertices, negative
// numbers, "a/b" texture references); other statements are skipped. Curves as
// JoinPolylines makes them. kDataLoss for a broken file, kUnsupported for an
// OBJ without lines.
Result<CurveSet> DecodeObjLines(std::string_view bytes);

}  // namespace curvix
