// SPDX-License-Identifier: BSD-3-Clause
// What the fuzzers of imports that name photographs share.
#pragma once

#include <string>
#include <string_view>

#include "plugin/imports/import_scene.h"
#include "tests/plugin/import_fixtures.h"
#include "tests/support/temporary_folder.h"

namespace curvix {

// An import of a file of that name and those bytes, beside photographs a.png
// and b.png of 640 x 480 pixels. There is one folder in each program.
inline ImportOptions ImportBesideImages(const std::string& name,
                                        std::string_view bytes) {
  static const TemporaryFolder folder;
  static const auto photographs = {folder.Write("a.png", PngOfSize(640, 480)),
                                   folder.Write("b.png", PngOfSize(640, 480))};
  ImportOptions options;
  options.image_path = photographs.begin()->parent_path();
  options.input_path = folder.Write(name, std::string(bytes));
  return options;
}

}  // namespace curvix
