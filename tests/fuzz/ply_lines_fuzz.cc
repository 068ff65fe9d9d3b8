// SPDX-License-Identifier: BSD-3-Clause
// Line sets of any program as .ply.

#include "io/curve_formats.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/io/test_curves.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  const std::string head = "ply\nformat ascii 1.0\n";
  return {EncodedCurves(EncodePlyLines, MakeTestCurves(), ""),
          head +
              "element vertex 3\nproperty float x\nproperty double y\n"
              "property int z\nproperty list uchar int more\n"
              "element edge 2\nproperty int vertex1\nproperty int vertex2\n"
              "end_header\n0 0 0 0\n1 0 0 2 5 6\n1 1 0 0\n0 1\n1 2\n"};
}

void FuzzReader(std::string_view bytes) {
  const Result<CurveSet> curves = DecodePlyLines(bytes);
  RequireSentence(curves.status());
  if (!curves.ok()) return;
  for (const Curve& curve : curves->curves) {
    Require(curve.samples.size() >= 2, "a curve has two samples");
  }
}

}  // namespace curvix
