// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Chooses the format by the extension.
#include <curvix/curve_io.h>
#include <curvix/file_io.h>

#include "output/ply_lines.h"

namespace curvix {
namespace {

Status UnknownExtension(const std::filesystem::path& path) {
  return {StatusCode::kInvalidArgument,
          path.string() +
              " does not end in .ply, .pcd, .obj or .txt, so its "
              "format is not known."};
}

Status Write(const std::filesystem::path& path,
             const Result<std::string>& bytes) {
  return bytes.ok() ? WriteFileAtomically(path, *bytes) : bytes.status();
}

}  // namespace

Status WriteCurves(const std::filesystem::path& path,
                   const CurveSet& curves,
                   const Scene&) {
  if (path.extension() == ".ply") return Write(path, EncodePlyLines(curves));
  return UnknownExtension(path);
}

Status WriteEdges(const std::filesystem::path& path,
                  const std::vector<Edge3d>& edges) {
  if (path.extension() == ".ply") return Write(path, EncodePlyEdges(edges));
  return UnknownExtension(path);
}

}  // namespace curvix
