// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/drawing_files.h"

#include <utility>

#include "base/file_io.h"
#include "colmap/files.h"
#include "io/sheet_formats.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

bool IsMapOfDrawing(const fs::path& path) {
  const Result<std::string> bytes = ReadFile(path);
  // The layer, and a field that GDAL makes of a DXF.
  return bytes.ok() && bytes->find("\"curves\"") != std::string::npos &&
         bytes->find("EntityHandle") != std::string::npos;
}

}  // namespace

std::vector<fs::path> FilesOfDrawing(const fs::path& folder,
                                     const std::string& name) {
  const Result<std::string> svg = ReadFile(folder / (name + ".svg"));
  if (!svg.ok() || !IsSvgSheet(*svg)) return {};
  std::vector<fs::path> files;
  if (fs::exists(folder / (name + ".dxf"))) files.emplace_back(name + ".dxf");
  files.emplace_back(name + ".svg");
  if (svg->find("<image ") != std::string::npos) {
    files.emplace_back(name + ".jpg");
  }
  for (const char* ending : {".gpkg", ".geojson"}) {
    if (IsMapOfDrawing(folder / (name + ending))) {
      files.emplace_back(name + ending);
    }
  }
  return files;
}

std::vector<fs::path> FilesOfDrawings(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::path& path : EntriesOf(folder)) {
    if (path.extension() != ".svg") continue;
    for (fs::path& file : FilesOfDrawing(folder, path.stem().string())) {
      files.push_back(std::move(file));
    }
  }
  return files;
}

}  // namespace curvix
