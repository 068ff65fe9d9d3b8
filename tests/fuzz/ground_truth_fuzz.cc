// SPDX-License-Identifier: BSD-3-Clause
// The true curves that `evaluate` compares with.

#include "evaluation/ground_truth.h"
#include "tests/fuzz/fuzz_target.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  return {"# x y z\n0 0 0\n1, 2, 3\n",
          "0 0 0 1 0 0 4 7 9 3\n0 1 0 1 0 0 4 7 9 1\n",
          "0 0 0 1 0 0 4 7 9\n+1e3 -2.5 0 0 1 0 5 1 2\n"};
}

void FuzzReader(std::string_view bytes) {
  const Result<GroundTruth> truth = ParseGroundTruth(bytes);
  RequireSentence(truth.status());
  if (truth.ok()) {
    GroundTruth classed = *truth;
    RequireSentence(ParseCurveKinds(bytes, classed));
  }
  Require(!truth.ok() || !truth->samples.empty(), "no truth without samples");
}

}  // namespace curvix
