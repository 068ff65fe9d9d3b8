// SPDX-License-Identifier: BSD-3-Clause
// Drawings for geographic information systems.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <string>

namespace curvix {

struct WantedMaps {
  bool geopackage = false;
  bool geojson = false;
};

// Writes the curves of a DXF drawing, without frame and dimensions, as the
// layer `curves` of the files that are wanted, which have its name; their
// layers are in the field `Layer`. `crs`: "EPSG:25832", say; "": not known. The
// same bytes for the same drawing. Names of files written are added to `text`.
// kUnsupported: the program was built without GDAL; kExternalTool: GDAL cannot.
Status WriteMapFiles(const std::filesystem::path& dxf,
                     const std::string& crs,
                     const WantedMaps& wanted,
                     std::string* text);

}  // namespace curvix
