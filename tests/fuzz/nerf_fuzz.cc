// SPDX-License-Identifier: BSD-3-Clause
// NeRF's transforms.json.

#include "plugin/imports/importers.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/two_photographs.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  std::mt19937 random(1);
  const auto frame = [&](const std::string& path, const std::string& more) {
    return "{\"file_path\": \"" + path + "\", " + more +
           "\"transform_matrix\": " +
           MatrixJson(NerfMatrix(RandomPose(random))) + "}";
  };
  return {
      "{\"fl_x\": 700, \"fl_y\": 710, \"cx\": 310, \"cy\": 245, \"k1\": "
      "0.1, \"w\": 640, \"h\": 480, \"frames\": [" +
          frame("./a", "") + "," + frame("b.png", "\"fl_x\": 600, ") + "]}",
      "{\"camera_angle_x\": 0.7, \"frames\": [" + frame("a.png", "") + "]}",
      "{\"camera_model\": \"OPENCV_FISHEYE\", \"fl_x\": 500, \"frames\": "
      "[" +
          frame("b",
                "\"camera_intrinsics\": " + MatrixJson(TestCalibration()) +
                    ", ") +
          "]}"};
}

void FuzzReader(std::string_view bytes) {
  const ImportOptions options = ImportBesideImages("transforms.json", bytes);
  RequireSentence(ImportNerf(options).status());
}

}  // namespace curvix
