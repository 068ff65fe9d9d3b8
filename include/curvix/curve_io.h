// SPDX-License-Identifier: BSD-3-Clause
// Curves and edges to and from files; docs/output_format.md describes each.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/fitting.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <filesystem>
#include <string_view>
#include <vector>

namespace curvix {

// Writes `curves` in the format that the extension names: .ply (line set),
// .pcd (point cloud with curve ids), .obj (lines), .txt (readable), .vtp (VTK
// polylines) or .glb (glTF lines). The file appears whole or not at all.
// `scene` must hold every view that a sample names, for .txt to list the ids of
// the images that support it; it lists none for an empty scene. `frame`: the
// line by which .ply tells of the frame; "": that of the model.
// kInvalidArgument for another extension, or if a curve has fewer than two
// samples, or a position, tangent or sigma that is not finite, or a coordinate
// beyond the floats of 32 bits, in all formats alike; kNotFound or kDataLoss if
// the path cannot be written, kUnsupported for more curves than the format can
// hold, and curves.status().
Status WriteCurves(const std::filesystem::path& path,
                   const CurveSource& curves,
                   const Scene& scene = {},
                   std::string_view frame = {});
inline Status WriteCurves(const std::filesystem::path& path,
                          const CurveSet& curves,
                          const Scene& scene = {}) {
  return WriteCurves(path, CurvesInMemory(curves), scene);
}

// Reads a line set back: .ply with `element edge`, .obj with `l` lines, or the
// .txt that WriteCurves writes. Lines of other programs are joined where two of
// them share a vertex and end where three or more do. Support is read from .txt
// only, as views without an edge (edge_idx 0); ids of images that `scene` does
// not have are left out, so an empty scene reads the geometry alone.
// kNotFound, kDataLoss (broken or truncated; no memory is taken on the word of
// a count), kUnsupported (no lines in it) or kInvalidArgument (extension).
Result<CurveSet> ReadCurves(const std::filesystem::path& path,
                            const Scene& scene = {});

// Writes oriented 3D edges as points: .ply with tangents and support counts.
// Errors as WriteCurves.
Status WriteEdges(const std::filesystem::path& path,
                  const std::vector<Edge3d>& edges);

// Writes fitted curves for CAD: .dxf, of AutoCAD 2000, with LINE, ARC, CIRCLE,
// ELLIPSE and SPLINE entities on a layer per kind; or .step, of AP242, with the
// same curves, where one unit of the world is declared a millimetre. DXF
// declares `unit`, that of the world, if it is "mm", "cm", "m", "in" or "ft".
// Errors as WriteCurves.
Status WriteDrawing(const std::filesystem::path& path,
                    const FittedCurves& fitted,
                    std::string_view unit = {});

// Writes the curves as a view sees them: .svg, in the pixels of its image. What
// the view does not show (ProjectedStretch) is drawn faintly. Errors as
// WriteCurves.
Status WriteProjection(const std::filesystem::path& path,
                       const CurveSource& curves,
                       const Scene& scene,
                       int view_idx);

}  // namespace curvix
