// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Chooses the format by the extension.
#include <curvix/curve_io.h>
#include <curvix/file_io.h>

#include <string>

#include "output/dxf_drawing.h"
#include "output/glb_curves.h"
#include "output/obj_lines.h"
#include "output/pcl_lines.h"
#include "output/ply_lines.h"
#include "output/svg_curves.h"
#include "output/txt_curves.h"
#include "output/vtp_curves.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Result<std::string> Encode(const std::string& extension,
                           const CurveSet& curves,
                           const Scene& scene) {
  if (extension == ".ply") return EncodePlyLines(curves);
  if (extension == ".pcd") return EncodePcd(ToPointCloud(curves));
  if (extension == ".obj") return EncodeObjLines(curves);
  if (extension == ".txt") return EncodeTxtCurves(curves, scene);
  if (extension == ".vtp") return EncodeVtpCurves(curves);
  if (extension == ".glb") return EncodeGlbCurves(curves);
  return Status(StatusCode::kInvalidArgument,
                "curves are written as .ply, .pcd, .obj, .txt, .vtp or .glb, "
                "not as \"" +
                    extension + "\"");
}

Result<CurveSet> Decode(const std::string& extension,
                        const std::string& bytes,
                        const Scene& scene) {
  if (extension == ".ply") return DecodePlyLines(bytes);
  if (extension == ".obj") return DecodeObjLines(bytes);
  if (extension == ".txt") return DecodeTxtCurves(bytes, scene);
  return Status(StatusCode::kInvalidArgument,
                "curves are read from .ply, .obj or .txt, not from \"" +
                    extension + "\"");
}

// The same status with the file that it is about.
Status About(const fs::path& path, const Status& status) {
  return {status.code(), path.string() + ": " + status.message() + "."};
}

Status Write(const fs::path& path, const Result<std::string>& bytes) {
  if (!bytes.ok()) return About(path, bytes.status());
  return WriteFileAtomically(path, *bytes);
}

}  // namespace

Status WriteCurves(const fs::path& path,
                   const CurveSet& curves,
                   const Scene& scene) {
  return Write(path, Encode(path.extension().string(), curves, scene));
}

Result<CurveSet> ReadCurves(const fs::path& path, const Scene& scene) {
  const Result<std::string> bytes = ReadFile(path);
  if (!bytes.ok()) return bytes.status();
  Result<CurveSet> curves = Decode(path.extension().string(), *bytes, scene);
  if (!curves.ok()) return About(path, curves.status());
  return curves;
}

Status WriteEdges(const fs::path& path, const std::vector<Edge3d>& edges) {
  if (path.extension() != ".ply") {
    return About(path,
                 {StatusCode::kInvalidArgument, "edges are written as .ply"});
  }
  return Write(path, EncodePlyEdges(edges));
}

Status ConcatenateEdges(const fs::path& path,
                        const std::vector<fs::path>& parts) {
  std::string rows;
  for (const fs::path& part : parts) {
    const Result<std::string> bytes = ReadFile(part);
    if (!bytes.ok()) return bytes.status();
    const Status status = AppendPlyEdges(*bytes, rows);
    if (!status.ok()) return About(part, status);
  }
  return Write(path, PlyEdgesOfRows(std::move(rows)));
}

Status WriteDrawing(const fs::path& path, const FittedCurves& fitted) {
  if (path.extension() != ".dxf") {
    return About(path,
                 {StatusCode::kInvalidArgument,
                  "a drawing of fitted curves is written as .dxf, not as \"" +
                      path.extension().string() + "\""});
  }
  return Write(path, EncodeDxfDrawing(fitted));
}

Status WriteProjection(const fs::path& path,
                       const CurveSet& curves,
                       const View& view,
                       const Camera& camera) {
  if (path.extension() != ".svg") {
    return About(path,
                 {StatusCode::kInvalidArgument,
                  "projected curves are written as .svg, not as \"" +
                      path.extension().string() + "\""});
  }
  return Write(path, EncodeSvgCurves(curves, view, camera));
}

}  // namespace curvix
