// SPDX-License-Identifier: BSD-3-Clause
// cameras.txt, images.txt and points3D.txt: the first character chooses.
#include "tests/fuzz/colmap_round_trip.h"
#include "tests/support/colmap_text.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  const ColmapModel model = SmallModel();
  return {"0" + FormatCamerasText(model.cameras),
          "1" + FormatImagesText(model.images),
          "2" + FormatPointsText(model.points)};
}

void FuzzReader(std::string_view bytes) {
  switch (TakeChoice(bytes, 3)) {
    case 0:
      return RoundTrip(
          bytes, ParseAllCamerasText, FormatCamerasText, &ColmapModel::cameras);
    case 1:
      return RoundTrip(
          bytes, ParseImagesText, FormatImagesText, &ColmapModel::images);
    default:
      return RoundTrip(
          bytes, ParsePointsText, FormatPointsText, &ColmapModel::points);
  }
}

}  // namespace curvix
