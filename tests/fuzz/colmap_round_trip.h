// SPDX-License-Identifier: BSD-3-Clause
// What the fuzzers of COLMAP's two formats share.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "colmap/colmap_model_format.h"
#include "tests/colmap/random_model.h"
#include "tests/fuzz/fuzz_target.h"

namespace curvix {

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

inline ColmapModel SmallModel() {
  ColmapModel model = RandomModel(1);
  for (ColmapPoint3D& point : model.points) {
    point.track.resize(std::min<std::size_t>(point.track.size(), 9));
  }
  return model;
}

}  // namespace curvix
