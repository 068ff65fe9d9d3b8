// SPDX-License-Identifier: BSD-3-Clause
// Codes of coordinate systems.
#pragma once

#include <curvix/status.h>
#include <string>

namespace curvix {

// kInvalidArgument unless `code` is the number of a coordinate system of EPSG
// whose coordinates are metres, as far as GDAL knows; without GDAL, unless it
// is a number of one.
Status CheckEpsg(const std::string& code);

}  // namespace curvix
