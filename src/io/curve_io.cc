// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Chooses the format by the extension.
#include <curvix/curve_io.h>
#include <functional>
#include <string>
#include <string_view>

#include "base/file_io.h"
#include "io/curve_formats.h"
#include "io/pcl_lines.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// kInvalidArgument: another extension than ".ply" and so on.
Status Encode(const std::string& extension,
              const CurveSource& curves,
              const Scene& scene,
              std::string_view frame,
              const ByteSink& sink) {
  if (extension == ".ply") return EncodePlyLines(curves, frame, sink);
  if (extension == ".pcd") return EncodePcd(curves, sink);
  if (extension == ".glb") return EncodeGlbCurves(curves, sink);
  if (extension == ".obj") {
    EncodeObjLines(curves, sink);
  } else if (extension == ".txt") {
    EncodeTxtCurves(curves, scene, sink);
  } else if (extension == ".vtp") {
    EncodeVtpCurves(curves, sink);
  } else {
    return Status::InvalidArgument(
        "curves are written as .ply, .pcd, .obj, .txt, .vtp or .glb, not as "
        "\"" +
        extension + "\"");
  }
  return {};
}

Result<CurveSet> Decode(const std::string& extension,
                        const std::string& bytes,
                        const Scene& scene) {
  if (extension == ".ply") return DecodePlyLines(bytes);
  if (extension == ".obj") return DecodeObjLines(bytes);
  if (extension == ".txt") return DecodeTxtCurves(bytes, scene);
  return Status::InvalidArgument(
      "curves are read from .ply, .obj or .txt, not from \"" + extension +
      "\"");
}

// A file of what `encode` gives for its extension; of `curves`, if there are
// any, all of which can be read.
using Encoder =
    std::function<Status(const std::string& extension, const ByteSink& sink)>;
Status Write(const fs::path& path,
             const Encoder& encode,
             const CurveSource* curves = nullptr) {
  FileWriter file(path);
  const Status status = encode(ExtensionOf(path), file.Sink());
  if (curves != nullptr && !curves->status().ok()) return curves->status();
  return status.ok() ? file.Finish() : InFile(path, status);
}

}  // namespace

Status WriteCurves(const fs::path& path,
                   const CurveSource& curves,
                   const Scene& scene,
                   std::string_view frame) {
  return Write(
      path,
      [&](const std::string& extension, const ByteSink& sink) {
        return Encode(extension, curves, scene, frame, sink);
      },
      &curves);
}

Result<CurveSet> ReadCurves(const fs::path& path, const Scene& scene) {
  const Result<std::string> bytes = ReadFile(path);
  if (!bytes.ok()) return bytes.status();
  Result<CurveSet> curves = Decode(ExtensionOf(path), *bytes, scene);
  if (!curves.ok()) return InFile(path, curves.status());
  return curves;
}

Status WriteEdges(const fs::path& path, const std::vector<Edge3d>& edges) {
  return Write(path, [&](const std::string& extension, const ByteSink& sink) {
    return extension == ".ply"
               ? EncodePlyEdges(edges, sink)
               : Status::InvalidArgument("edges are written as .ply");
  });
}

Status WriteDrawing(const fs::path& path,
                    const FittedCurves& fitted,
                    std::string_view unit) {
  return Write(path, [&](const std::string& extension, const ByteSink& sink) {
    if (extension == ".dxf") {
      EncodeDxfDrawing(fitted, unit, sink);
    } else if (extension == ".step") {
      EncodeStepDrawing(fitted, sink);
    } else {
      return Status::InvalidArgument(
          "fitted curves are written as .dxf or .step, not as \"" + extension +
          "\"");
    }
    return Status();
  });
}

Status WriteProjection(const fs::path& path,
                       const CurveSource& curves,
                       const Scene& scene,
                       int view_idx) {
  return Write(
      path,
      [&](const std::string& extension, const ByteSink& sink) {
        if (extension != ".svg") {
          return Status::InvalidArgument(
              "projected curves are written as .svg, not as \"" + extension +
              "\"");
        }
        if (view_idx < 0 || view_idx >= std::ssize(scene.views)) {
          return Status::InvalidArgument("there is no view " +
                                         std::to_string(view_idx));
        }
        EncodeSvgCurves(curves, scene, view_idx, sink);
        return Status();
      },
      &curves);
}

}  // namespace curvix
