// SPDX-License-Identifier: BSD-3-Clause
// The curves.txt that the program writes.

#include "io/curve_formats.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/io/test_curves.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  return {EncodedCurves(EncodeTxtCurves, MakeTestCurves(), MakeTestScene())};
}

void FuzzReader(std::string_view bytes) {
  const Scene scene = MakeTestScene();
  const Result<CurveSet> curves = DecodeTxtCurves(bytes, scene);
  RequireSentence(curves.status());
  if (!curves.ok()) return;
  const std::string again = EncodedCurves(EncodeTxtCurves, *curves, scene);
  Require(DecodeTxtCurves(again, scene).ok(), "what is written can be read");
}

}  // namespace curvix
