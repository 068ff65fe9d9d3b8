// SPDX-License-Identifier: BSD-3-Clause
// NumPy's .npz.

#include "base/file_io.h"
#include "plugin/imports/npy.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/plugin/import_fixtures.h"
#include "tests/support/temporary_folder.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "cameras.npz";
  WriteNpz(path,
           {{"world_mat_0", NpyOfMatrix(Eigen::Matrix4d::Identity())},
            {"scale_mat_0", NpyOfMatrix(Eigen::Matrix4d::Ones())}});
  return {*ReadFile(path)};
}

void FuzzReader(std::string_view bytes) {
  static const TemporaryFolder folder;
  const auto path = folder.Write("cameras.npz", std::string(bytes));
  RequireSentence(
      ReadNpz(path, [](const std::string&) { return true; }).status());
}

}  // namespace curvix
