// SPDX-License-Identifier: BSD-3-Clause
// examples/cluster, as a person runs it on one machine. On Slurm:
// tests/evaluation/run_scale.py --slurm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <filesystem>
#include <string>

#include "plugin/commands/command_synthesize.h"
#include "tests/end_to_end/run_program.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

const fs::path kCluster = fs::path(CURVIX_SOURCE_DIR) / "examples/cluster";

class Cluster : public testing::Test {
 protected:
  void SetUp() override {
    SyntheticOptions options;
    options.solid = SyntheticSolid::kFacade;
    options.num_views = 48;
    options.width = 120;
    options.height = 90;
    options.points_per_view = 10;
    ASSERT_TRUE(Synthesize(options, street_).ok());
  }

  // Step by step, without Snakemake; the words of the program.
  std::string Step(const std::string& step) {
    const Outcome outcome =
        RunProgram(step + " --workspace_path " + Quoted(street_) +
                   " --output_path " + Quoted(folder_.path() / "steps"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return outcome.output;
  }

  TemporaryFolder folder_;
  const fs::path street_ = folder_.path() / "street";
};

TEST_F(Cluster, SnakemakeGivesWhatTheStepsGive) {
  if (RunInShell("snakemake --version 2>&1").exit_code != 0) {
    GTEST_SKIP() << "snakemake is not installed";
  }
  const fs::path results = folder_.path() / "snakemake";
  const Outcome outcome = RunInShell(
      "cd " + Quoted(folder_.path()) + " && HOME=" + Quoted(folder_.path()) +
      " snakemake --snakefile " + Quoted(kCluster / "Snakefile") +
      " --cores 2 --config workspace=" + Quoted(street_) + " results=" +
      Quoted(results) + " program=" + Quoted(fs::path(CURVIX_PROGRAM)) +
      " max_views_per_part=44 'paths=--image_path " +
      (street_ / "images").string() + "' 2>&1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;

  EXPECT_THAT(Step("partition --max_views_per_part 44"),
              testing::HasSubstr("part 1:"));
  for (int k = 0; fs::exists(results / "parts" / std::to_string(k)); ++k) {
    Step("reconstruct --part " + std::to_string(k));
  }
  Step("merge");
  for (const char* name : {"curves.ply", "curves.json", "edges.ply"}) {
    EXPECT_EQ(Read(results / name), Read(folder_.path() / "steps" / name));
    EXPECT_FALSE(Read(results / name).empty());
  }
}

}  // namespace
}  // namespace curvix
