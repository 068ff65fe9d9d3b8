// SPDX-License-Identifier: BSD-3-Clause
// DTU's calibration, pos_001.txt: a projection matrix as text.

#include "plugin/imports/importers.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/plugin/import_fixtures.h"
#include "tests/support/temporary_folder.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  std::mt19937 random(1);
  return {MatrixText(TestCalibration() * Matrix34(RandomPose(random)))};
}

void FuzzReader(std::string_view bytes) {
  static const TemporaryFolder folder;
  static const auto photograph =
      folder.Write("images/rect_001_max.png", PngOfSize(640, 480));
  ImportOptions options;
  options.image_path = photograph.parent_path();
  options.input_path =
      folder.Write("cal/pos_001.txt", std::string(bytes)).parent_path();
  RequireSentence(ImportDtu(options).status());
}

}  // namespace curvix
