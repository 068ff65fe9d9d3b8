// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves as text that people and scripts read, in
// the manner of COLMAP's points3D.txt; docs/output_format.md.
#pragma once

#include <curvix/curves.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <string_view>

#include "base/file_io.h"

namespace curvix {

// Four comment lines, then per curve one line
//   CURVE_ID CLOSED NUM_SAMPLES
// and NUM_SAMPLES lines
//   X Y Z TX TY TZ SIGMA KIND IMAGE_ID...
// with numbers as short as they can be and still read back exactly, whatever
// the locale, and KindName(). `scene` turns views into image ids; of an empty
// one no ids are written, of another support must name its views.
void EncodeTxtCurves(const CurveSource& curves,
                     const Scene& scene,
                     const ByteSink& sink);

// Reads that back. Curves keep their order, whatever ids they carry. An image
// id becomes support {view, edge 0}; ids that `scene` does not have are left
// out, so an empty scene reads the geometry alone. kDataLoss if a line is not
// as above; memory stays in proportion to bytes.size().
Result<CurveSet> DecodeTxtCurves(std::string_view bytes, const Scene& scene);

}  // namespace curvix
