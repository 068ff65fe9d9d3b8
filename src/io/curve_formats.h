// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves in the formats of other programs;
// docs/output_format.md.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/fitting.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <filesystem>
#include <string_view>
#include <vector>

#include "base/file_io.h"

namespace curvix {

// PLY, binary little endian. Vertex: float x y z tx ty tz, uchar red green blue
// (one colour per curve), float curve_id confidence support, and if the kind of
// any sample is known, uchar kind (CurveKind), float kind_probability. Edge:
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

// VTK XML PolyData, text: one polyline per curve (a closed one returns to its
// first point), with point arrays tangent, sigma, support and confidence, and
// cell arrays curve_id and length.
void EncodeVtpCurves(const CurveSource& curves, const ByteSink& sink);

// Binary glTF 2.0: a mesh of one primitive per curve, a line strip, or a line
// loop if it is closed, with positions and colours, unlit; node "curves", and
// the id of a curve in the primitive's extras. Positions are 32-bit floats
// relative to the node's translation, the middle of the curves, so that far
// origins lose no digits. The node turns z up to y up, as glTF has it.
// kUnsupported beyond 4 GB.
Status EncodeGlbCurves(const CurveSource& curves, const ByteSink& sink);

// SVG in the pixels of the view: one group per curve in its colour, class
// "curve", id "curve_<id>", with a faint path of class "hidden" and one of
// class "shown" (ProjectedStretch); empty if the curve is outside the image.
void EncodeSvgCurves(const CurveSource& curves,
                     const Scene& scene,
                     int view_idx,
                     const ByteSink& sink);

// Per curve `o curve_<id>`, `v x y z r g b` per sample (colours in 0..1) and
// `l a b` per segment, the closing one last. Segments and not polylines:
// Blender and MeshLab show only the first segment of a longer `l`.
void EncodeObjLines(const CurveSource& curves, const ByteSink& sink);

// The curves of any OBJ with `v` and `l` (also `l` of many vertices, negative
// numbers, "a/b" texture references); other statements are skipped. Curves as
// JoinPolylines makes them. kDataLoss for a broken file, kUnsupported for an
// OBJ without lines.
Result<CurveSet> DecodeObjLines(std::string_view bytes);

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

// DXF of AutoCAD 2000 (AC1015), text: LINE, ARC, CIRCLE, ELLIPSE and SPLINE
// entities in model space, in the order of the curves, on one layer per kind of
// curve (drawing_layers.h). Coordinates are those of the model; `unit` is
// declared if DxfHeader knows it.
void EncodeDxfDrawing(const FittedCurves& fitted,
                      std::string_view unit,
                      const ByteSink& sink);

// STEP (ISO 10303-21) of AP242: the product "curves", a geometrically bounded
// wireframe. Lines and arcs are TRIMMED_CURVEs of LINE, CIRCLE and ELLIPSE,
// whole ones CIRCLE and ELLIPSE, splines B_SPLINE_CURVE_WITH_KNOTS; each is
// named after its curve, "curve_<id>". There is one GEOMETRIC_CURVE_SET per
// type, in the order of ARCS, CIRCLES, ELLIPSES, LINES and SPLINES, on a layer
// of that name; in it the curves are in their order. Coordinates are those of
// the model. STEP must declare a unit: millimetres.
void EncodeStepDrawing(const FittedCurves& fitted, const ByteSink& sink);

}  // namespace curvix
