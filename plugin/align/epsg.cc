// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/epsg.h"

#ifdef CURVIX_HAS_GDAL
#include <cpl_conv.h>
#include <ogr_srs_api.h>
#endif
#include <cmath>
#include <optional>

#include "base/text_fields.h"

namespace curvix {
namespace {

// What is wrong with it; "": nothing.
#ifdef CURVIX_HAS_GDAL
constexpr double kSameUnit = 1e-9;  // m

std::string WhyNotInMetres(int code) {
  const OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
  CPLPushErrorHandler(CPLQuietErrorHandler);
  std::string why;
  if (OSRImportFromEPSG(system, code) != OGRERR_NONE) {
    why = "which GDAL does not know: " + std::string(CPLGetLastErrorMsg());
  } else if (OSRIsGeographic(system) != 0) {
    why = "whose coordinates are degrees";
  } else if (OSRIsProjected(system) == 0) {
    why = "whose axes are not east and north";
  } else {
    char* unit = nullptr;
    const double metres = OSRGetLinearUnits(system, &unit);
    if (std::abs(metres - 1) > kSameUnit) {
      why = "whose coordinates are in the unit " + std::string(unit);
    }
  }
  CPLPopErrorHandler();
  OSRDestroySpatialReference(system);
  return why;
}
#else
std::string WhyNotInMetres(int) { return ""; }
#endif

}  // namespace

Status CheckEpsg(const std::string& code) {
  const std::optional<int> number = ParseNumber<int>(code);
  const std::string why = number && *number >= 1024 && *number <= 32767
                              ? WhyNotInMetres(*number)
                              : "which is no code of EPSG";
  if (why.empty()) return {};
  return Status::InvalidArgument(
      "--epsg is " + code + ", " + why +
      "; it takes the number of a system with metres, as 25832, into which "
      "gdaltransform converts positions");
}

}  // namespace curvix
