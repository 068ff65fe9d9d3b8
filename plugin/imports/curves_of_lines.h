// SPDX-License-Identifier: BSD-3-Clause
// Lines of other programs as curves of a scene.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <vector>

#include "plugin/imports/read_lines.h"

namespace curvix {

struct LineCurves {
  CurveSet curves;
  std::vector<EdgeMap> edge_maps;  // one per view: what the samples refer to
  int num_without_length = 0;      // lines left out
  int num_seen = 0;                // lines whose middle some view sees
};

// A curve of two samples per line, in the order of the lines. A sample is
// supported by the views whose images show the line and in which it lies, by an
// edge where the view sees it, along the line: how far the edges of the image
// are from there is not known. Images that the scene does not have are left
// out. kInvalidArgument if no view sees any line: they are of another world.
Result<LineCurves> CurvesOfLines(const std::vector<ImportedLine>& lines,
                                 const Scene& scene);

}  // namespace curvix
