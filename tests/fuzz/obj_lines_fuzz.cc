// SPDX-License-Identifier: BSD-3-Clause
// Line sets of any program as .obj.

#include "io/curve_formats.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/io/test_curves.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  return {EncodedCurves(EncodeObjLines, MakeTestCurves()),
          "# lines\nv 0 0 0\nv 1 0 0 1 1 1\nv 1 1 0\nvt 0 0\nl -3/1 -2 -1\nl 1 "
          "\\\n3\n"};
}

void FuzzReader(std::string_view bytes) {
  const Result<CurveSet> curves = DecodeObjLines(bytes);
  RequireSentence(curves.status());
  if (!curves.ok()) return;
  for (const Curve& curve : curves->curves) {
    Require(curve.samples.size() >= 2, "a curve has two samples");
  }
}

}  // namespace curvix
