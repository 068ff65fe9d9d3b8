// SPDX-License-Identifier: BSD-3-Clause
// A scene with a few curves, for commands that work on curves.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/commands/command_synthesize.h"
#include "tests/end_to_end/run_program.h"
#include "tests/support/temporary_folder.h"

namespace curvix {

// A block of size 1 with curves, in small images.
class BlockTest : public testing::Test {
 protected:
  void SetUp() override {
    SyntheticOptions options;
    options.solid = SyntheticSolid::kBlock;
    options.num_views = 12;
    options.width = 240;
    options.height = 240;
    ASSERT_TRUE(Synthesize(options, workspace_).ok());
    ASSERT_EQ(Run("").exit_code, 0);
  }

  Outcome Run(const std::string& words) {
    return RunProgram(words + " --workspace_path " + Quoted(workspace_));
  }
  // The program fails and says why.
  void ExpectError(const std::string& words, const std::string& why) {
    const Outcome outcome = Run(words);
    EXPECT_NE(outcome.exit_code, 0) << words;
    EXPECT_TRUE(HasError(outcome.output)) << words;
    EXPECT_THAT(outcome.output, testing::HasSubstr(why)) << words;
  }
  nlohmann::json Curves() {
    return nlohmann::json::parse(Read(results_ / "curves.json"));
  }

  TemporaryFolder folder_;
  const std::filesystem::path workspace_ = folder_.path() / "proj";
  const std::filesystem::path results_ = workspace_ / "curvix/0";
};

}  // namespace curvix
