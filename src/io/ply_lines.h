// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Line sets as PLY; docs/output_format.md.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/status.h>
#include <filesystem>
#include <string_view>
#include <vector>

#include "base/file_io.h"

namespace curvix {

// Binary little endian. Vertex: float x y z tx ty tz, uchar red green blue (one
// colour per curve), float curve_id confidence support, and if the kind
// of any sample is known, uchar kind (CurveKind), float kind_probability. Edge:
// int vertex1 vertex2. Only float and uchar in vertices: COLMAP aborts on
// anything else. Each curve has its own consecutive vertices, in order, and its
// edges follow in order too, the closing edge last. More than 2^31 - 1 vertices
// are kUnsupported. `frame`: a comment on the frame, of one line; "": it is
// that of the model.
Status EncodePlyLines(const CurveSource& curves,
                      std::string_view frame,
                      const ByteSink& sink);

// The same vertices for edges before they are grouped: float x y z tx ty tz,
// uchar red green blue (by direction), float support. No `element edge`.
Status EncodePlyEdges(const std::vector<Edge3d>& edges, const ByteSink& sink);

// Writes the edges of several such files, one after the other, as one, which
// appears whole or not at all. kNotFound, kDataLoss: a file is missing or is no
// such file, or `path` cannot be written; kUnsupported as above.
Status ConcatenatePlyEdges(const std::filesystem::path& path,
                           const std::vector<std::filesystem::path>& parts);

// The curves of any PLY with `element vertex` (x, y, z, of any scalar type) and
// `element edge` (vertex1, vertex2): ASCII or binary, with whatever further
// elements and properties. Vertices tx, ty, tz become tangents where present
// and not zero. Curves as JoinPolylines makes them; sigma 0, no support.
// kDataLoss for a file that is broken, truncated or not PLY, kUnsupported for a
// PLY without lines. Memory stays in proportion to bytes.size().
Result<CurveSet> DecodePlyLines(std::string_view bytes);

}  // namespace curvix
