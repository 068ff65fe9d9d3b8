// SPDX-License-Identifier: BSD-3-Clause
// The built program's command line, without data.
#include <filesystem>
#include <map>
#include <string>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/end_to_end/run_program.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(ProgramAlone, HelpAndVersionSucceed) {
  for (const char* words : {"",
                            "help",
                            "help --markdown",
                            "--help",
                            "--help_all",
                            "-h",
                            "reconstruct -h",
                            "synthesize --help",
                            "help evaluate",
                            "version",
                            "--version"}) {
    const Outcome outcome = RunProgram(words);
    EXPECT_EQ(outcome.exit_code, 0) << words;
    EXPECT_THAT(outcome.output, HasSubstr("colmap_curvix")) << words;
  }
}

TEST(ProgramAlone, WrongCommandLinesAreRefusedWithAHint) {
  const std::map<std::string, std::string> cases = {
      {"recontruct", "did you mean 'reconstruct'?"},
      {"--workspce_path x", "did you mean '--workspace_path'?"},
      {"--num_threads 2", "'--workspace_path' is required"},
      {"--workspace_path . --preset papr", "one of default, paper"},
      {"--workspace_path . --refiner other", "one of colmap, none"},
      {"--workspace_path . --Hypotheses.min_ray_angle_deg 90",
       "Hypotheses.min_ray_angle_deg"},
      {"evaluate --json", "either --curves_path and --truth_path, or"},
      {"evaluate --workspace_path x", "--truth_path or --holdout_every"},
      {"evaluate --truth_path x", "Give either"},
      {"evaluate --curves_path x --truth_path y --holdout_every 4",
       "Give either"},
      {"evaluate --workspace_path x --truth_path y --holdout_every 4",
       "Give either"},
      {"evaluate --workspace_path x --holdout_every 1", "must be >= 2"},
      {"evaluate --workspace_path x --holdout_every 4 "
       "--Hypotheses.min_ray_angle_deg 90",
       "Hypotheses.min_ray_angle_deg"},
      {"synthesize --workspace_path x --num_views 2", "num_views is 2"},
      {"synthesize --workspace_path x --width 9000", "width is 9000"},
      {"synthesize --workspace_path x --scale 1e-20", "scale is 1e-20"},
      {"synthesize --workspace_path x --camera_model PINHOLE --distortion 0.1",
       "PINHOLE has no radial coefficient"},
      {"import --workspace_path x --input_path y --format colmap_images",
       "'--image_path' is required"},
      {"align --workspace_path x --distance 0 1 nan", "not a number above 0"},
      {"align --workspace_path x --axes auto --up 0,0,0", "no direction"},
      {"align --workspace_path x", "something that is known"},
      {"draw --workspace_path x --plane zx", "is no plane"},
      {"draw --workspace_path x --plane xz,xy,xz", "xz twice"},
      {"draw --workspace_path x --plane 'nodes 1 2'", "three nodes"},
      {"draw --workspace_path x --slice 2,1", "lower and the higher"},
      {"draw --workspace_path x --name a/b", "without folders"},
      {"draw --workspace_path x --scale 1:0", "such as 1:50"}};
  for (const auto& [words, hint] : cases) {
    const Outcome outcome = RunProgram(words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_TRUE(HasError(outcome.output)) << words;
    EXPECT_THAT(outcome.output, HasSubstr(hint));
  }
}

TEST(ProgramAlone, AFolderInPlaceOfACommandIsAWorkspace) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "part");
  const Outcome outcome = RunInShell("cd " + Quoted(folder.path()) + " && '" +
                                     CURVIX_PROGRAM + "' part 2>&1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output,
              HasSubstr("did you mean '--workspace_path part'?"));
}

TEST(ProgramAlone, AMissingWorkspaceIsBadInput) {
  const Outcome outcome = RunProgram("--workspace_path /no/such/folder");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, HasSubstr("/no/such/folder"));
}

}  // namespace
}  // namespace curvix
