// SPDX-License-Identifier: BSD-3-Clause
// The planes that --plane names.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <string>
#include <vector>

#include "drawing/drawing_plane.h"
#include "plugin/align/curves_file.h"

namespace curvix {

// kInvalidArgument: it is no text for ChoosePlanes, whatever nodes there are.
Status CheckPlanes(const std::string& text);

// Whether ChoosePlanes() needs the samples of the curves.
bool HasPlaneOfNodes(const std::string& text);

// "xy", "xz", "yz", "auto" (MainPlane, of the axes of the alignment or else of
// those that lines share), "nodes A B C", seen from where images show the
// curves next to these nodes, or several with commas between. `scene` is in the
// frame of the curves. CheckPlanes() accepts `text`. kInvalidArgument: there is
// no such node, or nodes are on a line; kUnsupported: "auto", and no two
// directions are perpendicular.
Result<std::vector<DrawingPlane>> ChoosePlanes(const std::string& text,
                                               const CurvesFile& curves,
                                               const Scene& scene);

}  // namespace curvix
