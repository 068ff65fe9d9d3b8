// SPDX-License-Identifier: BSD-3-Clause
// Commands after a run whose images were not where they are looked for.
#include <filesystem>
#include <string>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/end_to_end/block_test.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ImagesElsewhere : public BlockTest {
 protected:
  // A run with them in photos/ beside the workspace, named from there.
  void SetUp() override {
    BlockTest::SetUp();
    fs::rename(workspace_ / "images", folder_.path() / "photos");
    fs::remove_all(results_);
    const Outcome outcome =
        RunInShell("cd " + Quoted(workspace_) + " && '" + CURVIX_PROGRAM +
                   "' --workspace_path . --image_path ../photos/ 2>&1");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  }

  static void ExpectThatAllGoesOn(const std::string& paths) {
    for (const char* words :
         {"draw --photograph auto --plane xz", "align --axes auto", "draw"}) {
      const Outcome outcome = RunProgram(words + paths);
      EXPECT_EQ(outcome.exit_code, 0) << words << ": " << outcome.output;
    }
  }
};

TEST_F(ImagesElsewhere, AreFoundAgain) {
  ExpectThatAllGoesOn(" --workspace_path " + Quoted(workspace_));
  // The run was repeated from its stages.
  const auto report = nlohmann::json::parse(Read(results_ / "report.json"));
  EXPECT_THAT(report["run"]["resumed_stages"].dump(),
              HasSubstr("detect_edges"));
}

TEST_F(ImagesElsewhere, AreFoundAgainWhenAllHasMoved) {
  const fs::path moved = folder_.path() / "to/here";
  fs::create_directories(moved);
  fs::rename(workspace_, moved / "proj");
  fs::rename(folder_.path() / "photos", moved / "photos");
  ExpectThatAllGoesOn(" --workspace_path " + Quoted(moved / "proj"));
}

TEST_F(ImagesElsewhere, GoBeforeThoseOfTheWorkspaceButNotThoseThatAreNamed) {
  fs::create_directory(workspace_ / "images");
  ExpectThatAllGoesOn(" --workspace_path " + Quoted(workspace_));
  ExpectError("draw --image_path " + Quoted(workspace_ / "images"),
              "Only 0 of the 12 images");
}

TEST_F(ImagesElsewhere, AreLookedForAsBeforeOnceTheyAreGone) {
  fs::rename(folder_.path() / "photos", workspace_ / "images");
  ExpectThatAllGoesOn(" --workspace_path " + Quoted(workspace_));
}

using MissingImages = BlockTest;

TEST_F(MissingImages, AreToldOnce) {
  fs::remove(workspace_ / "images/view_003.png");
  const std::string note = "1 of 12 images is not in";
  for (const char* words : {"align --axes auto",
                            "align --axes auto --write_results 0",
                            "align --distance 0 100000 1",
                            "draw"}) {
    const std::string output = Run(words).output;
    EXPECT_THAT(output, HasSubstr(note)) << words;
    EXPECT_EQ(output.find(note), output.rfind(note)) << words << output;
  }
}

}  // namespace
}  // namespace curvix
