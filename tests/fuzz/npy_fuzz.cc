// SPDX-License-Identifier: BSD-3-Clause
// NumPy's .npy.

#include "plugin/imports/npy.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/plugin/import_fixtures.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  return {NpyOfMatrix(Eigen::Matrix4d::Identity()),
          NpyFile("'>f4'", "True", "(4L, 4L)", std::string(64, '1'), 2),
          NpyFile("'<f8'", "False", "(4, 4, )", std::string(128, '1'), 3)};
}

void FuzzReader(std::string_view bytes) {
  RequireSentence(ParseNpy(bytes, "array").status());
}

}  // namespace curvix
