// SPDX-License-Identifier: BSD-3-Clause
// Drawings for geographic information systems.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <string>

namespace curvix {

// Writes the curves of a DXF drawing, without frame and dimensions, as the
// layer `curves` of `map`, a .gpkg (GeoPackage) or .geojson; their layers are
// in the field `Layer`. `crs`: "EPSG:25832", say; "": not known. The same bytes
// for the same drawing. kUnsupported: the program was built without GDAL;
// kExternalTool: GDAL cannot.
Status WriteMapFile(const std::filesystem::path& dxf,
                    const std::string& crs,
                    const std::filesystem::path& map);

}  // namespace curvix
