// SPDX-License-Identifier: BSD-3-Clause
// Middlebury's *_par.txt.
#include "plugin/import_middlebury.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/plugin/import_fixtures.h"
#include "tests/plugin/temporary_folder.h"

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
  static const TemporaryFolder folder;
  static const auto photographs = {folder.Write("a.png", PngOfSize(640, 480)),
                                   folder.Write("b.png", PngOfSize(640, 480))};
  ImportOptions options;
  options.image_path = photographs.begin()->parent_path();
  options.input_path = folder.Write("x_par.txt", std::string(bytes));
  RequireSentence(ImportMiddlebury(options).status());
}

}  // namespace curvix
