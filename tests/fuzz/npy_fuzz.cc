// SPDX-License-Identifier: BSD-3-Clause
// NumPy's .npy.

#include "plugin/imports/npy.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/plugin/import_fixtures.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  return {NpyOfMatrix(Eigen::Matrix4d::Identity()),
          NpyFile("'>f4'", "True", "(2,)", "12345678", 2),
          NpyFile("'<f8'", "False", "()", "12345678", 3)};
}

void FuzzReader(std::string_view bytes) {
  const Result<NpyArray> array = ParseNpy(bytes, "array");
  RequireSentence(array.status());
  if (!array.ok()) return;
  RequireSentence(MatrixFromNpy(*array, 4, 4, "array").status());
}

}  // namespace curvix
