// SPDX-License-Identifier: BSD-3-Clause
// Images of 10 and 12 bits, as industrial cameras write them.
#include <gtest/gtest.h>

#include <string>

#include "edge_detection/load_image.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

TEST(LoadGrayImage, BrightnessOfPgmIsRelativeToItsLargestValue) {
  const TemporaryFolder folder;
  const Camera camera{CameraModel::kSimplePinhole, 80, 60, {80, 40, 30}};
  const auto loaded = [&](int max_value) {
    std::string pgm = "P5\n80 60\n" + std::to_string(max_value) + "\n";
    for (int i = 0; i < 80 * 60; ++i) {
      const int value = i % 5 * max_value / 4;
      pgm += {static_cast<char>(value >> 8), static_cast<char>(value & 255)};
    }
    View view;
    view.image_path = folder.Write("deep.pgm", pgm);
    return *LoadGrayImage(view, camera);
  };
  for (const int max_value : {1023, 4095, 65535}) {
    const GrayImage image = loaded(max_value);
    for (int x = 0; x < 5; ++x) {
      EXPECT_NEAR(image.at(x, 0), 255.0 * x / 4, 0.3) << max_value;
    }
  }
}

}  // namespace
}  // namespace curvix
