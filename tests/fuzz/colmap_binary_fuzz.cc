// SPDX-License-Identifier: BSD-3-Clause
// cameras.bin, images.bin and points3D.bin: the first character chooses.
#include "plugin/colmap_model_format.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/plugin/random_model.h"

namespace curvix {
namespace {

// What was read is written and read again, and may be part of a model.
template <typename Parse, typename Format, typename List>
void RoundTrip(std::string_view bytes,
               const Parse& parse,
               const Format& format,
               List ColmapModel::*list) {
  auto read = parse(bytes, "file");
  RequireSentence(read.status());
  if (!read.ok()) return;
  const std::string again = format(*read);
  Require(parse(again, "file").ok(), "what is written can be read");
  ColmapModel model = RandomModel(1);
  model.*list = *std::move(read);
  RequireSentence(ValidateColmapModel(model));
  if (ValidateColmapModel(model).ok()) SceneFromColmapModel(model, "images");
}

ColmapModel SmallModel() {
  ColmapModel model = RandomModel(1);
  for (ColmapPoint3D& point : model.points) {
    point.track.resize(std::min<std::size_t>(point.track.size(), 9));
  }
  return model;
}

}  // namespace

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
