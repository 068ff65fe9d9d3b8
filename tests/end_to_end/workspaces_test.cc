// SPDX-License-Identifier: BSD-3-Clause
// Workspaces are read, or refused, as docs/workspaces.md says.
#include <string>

#include "gtest/gtest.h"
#include "tests/end_to_end/run_program.h"

namespace curvix {
namespace {

TEST(Workspaces, AreAsThePageSays) {
  const std::string source = CURVIX_SOURCE_DIR;
  const Outcome outcome = RunInShell(
      "/usr/bin/python3 " + Quoted(source + "/tests/end_to_end/workspaces.py") +
      " '" + CURVIX_PROGRAM + "' " + Quoted(source + "/docs/workspaces.md"));
  if (outcome.exit_code == kNotInstalled) {
    GTEST_SKIP() << "no python3-pil or python3-numpy";
  }
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

}  // namespace
}  // namespace curvix
