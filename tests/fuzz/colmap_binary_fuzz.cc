// SPDX-License-Identifier: BSD-3-Clause
// cameras.bin, images.bin and points3D.bin: the first character chooses.
#include "tests/fuzz/colmap_round_trip.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  const ColmapModel model = SmallModel();
  return {"0" + FormatCamerasBinary(model.cameras),
          "1" + FormatImagesBinary(model.images),
          "2" + FormatPointsBinary(model.points)};
}

void FuzzReader(std::string_view bytes) {
  switch (TakeChoice(bytes, 3)) {
    case 0:
      return RoundTrip(bytes,
                       ParseCamerasBinary,
                       FormatCamerasBinary,
                       &ColmapModel::cameras);
    case 1:
      return RoundTrip(
          bytes, ParseImagesBinary, FormatImagesBinary, &ColmapModel::images);
    default:
      return RoundTrip(
          bytes, ParsePointsBinary, FormatPointsBinary, &ColmapModel::points);
  }
}

}  // namespace curvix
