// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a workspace, and what the program must say.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/end_to_end/run_program.h"
#include "tests/end_to_end/small_workspace.h"

namespace curvix {

struct BadCase {
  std::string name;
  std::function<void(SmallWorkspace&)> spoil;
  std::string says;  // part of the one sentence
  int exit_code = 3;
  std::string arguments = {};  // further ones
};

// Calls change(ColmapModel&) and writes the model then.
template <typename Change>
auto Model(Change change) {
  return [change](SmallWorkspace& workspace) {
    change(workspace.model);
    workspace.WriteModel();
  };
}

// Runs the program: one sentence with `says`, the exit code, nothing under a
// final name, and the inputs as they were. Exit code 5, "no curves", leaves a
// report; a run with exit code 0 says what it says and leaves its results.
inline void ExpectOutcome(const BadCase& bad) {
  SCOPED_TRACE(bad.name);
  SmallWorkspace workspace;
  bad.spoil(workspace);
  const auto before = Contents(workspace.path());
  const Outcome outcome =
      RunProgram("--workspace_path " + Quoted(workspace.path()) + " --clean " +
                 bad.arguments);
  EXPECT_EQ(outcome.exit_code, bad.exit_code) << outcome.output;
  EXPECT_THAT(outcome.output, testing::HasSubstr(bad.says));
  EXPECT_THAT(outcome.output,
              testing::Not(testing::HasSubstr("wrong in colmap_curvix")));
  const bool has_error = HasError(outcome.output);
  EXPECT_EQ(has_error, bad.exit_code != 0 && bad.exit_code != 5);
  if (has_error) {
    const std::size_t error = outcome.output.find("ERROR: ");
    EXPECT_EQ(outcome.output.find('\n', error), outcome.output.size() - 1)
        << "more than one line: " << outcome.output;
  }
  if (bad.exit_code == 0 || bad.exit_code == 5) {
    std::filesystem::remove_all(workspace.At("curvix"));
  }
  EXPECT_EQ(Contents(workspace.path()), before);
}

inline void ExpectOutcome(const std::vector<BadCase>& cases) {
  for (const BadCase& bad : cases) ExpectOutcome(bad);
}

}  // namespace curvix
