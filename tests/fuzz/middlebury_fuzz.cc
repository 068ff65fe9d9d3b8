// SPDX-License-Identifier: BSD-3-Clause
// Middlebury's *_par.txt.

#include "plugin/imports/importers.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/two_photographs.h"

namespace curvix {
namespace {

std::string ParLine(const std::string& name) {
  return name + " " + MatrixText(TestCalibration()) +
         MatrixText(Eigen::Matrix3d::Identity()) + "0 0 5\n";
}

}  // namespace

std::vector<std::string> FuzzSeeds() {
  return {"2\n" + ParLine("a.png") + ParLine("b.png")};
}

void FuzzReader(std::string_view bytes) {
  const ImportOptions options = ImportBesideImages("x_par.txt", bytes);
  RequireSentence(ImportMiddlebury(options).status());
}

}  // namespace curvix
