// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Line sets as PLY; docs/output_format.md.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/status.h>

#include <string>
#include <string_view>
#include <vector>

namespace curvix {

// Binary little endian. Vertex: float x y z tx ty tz, uchar red green blue (one
// colour per curve), float curve_id confidence support, and if any curve is
// labelled as an occluding contour, uchar occluding (0 or 1). Edge: int vertex1
// vertex2. Only float and uchar in vertices: COLMAP aborts on anything else.
// Each curve has its own consecutive vertices, in order, and its edges follow
// in order too, the closing edge last. More than 2^31 - 1 vertices are
// kUnsupported.
Result<std::string> EncodePlyLines(const CurveSet& curves);

// The same vertices for edges before they are grouped: float x y z tx ty tz,
// uchar red green blue (by direction), float support. No `element edge`.
Result<std::string> EncodePlyEdges(const std::vector<Edge3d>& edges);

// Appends the edges of such a file to `rows`, and makes a file of rows again.
// kDataLoss: it is no such file.
Status AppendPlyEdges(std::string_view bytes, std::string& rows);
Result<std::string> PlyEdgesOfRows(std::string rows);

// The curves of any PLY with `element vertex` (x, y, z, of any scalar type) and
// `element edge` (vertex1, vertex2): ASCII or binary, with whatever further
// elements and properties. Vertices tx, ty, tz become tangents where present
// and not zero. Curves as JoinPolylines makes them; sigma 0, no support.
// kDataLoss for a file that is broken, truncated or not PLY, kUnsupported for a
// PLY without lines. Memory stays in proportion to bytes.size().
Result<CurveSet> DecodePlyLines(std::string_view bytes);

}  // namespace curvix
