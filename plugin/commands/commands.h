// SPDX-License-Identifier: BSD-3-Clause
// The words of the program: `colmap_curvix <word> --flags`.
#pragma once

#include <curvix/status.h>
#include <string>
#include <vector>

namespace curvix {

enum ExitCode : int {
  kExitSuccess = 0,
  kExitInternal = 1,     // our own mistake
  kExitCommandLine = 2,  // flags that cannot work
  kExitInput = 3,        // files or folders that are missing or broken
  kExitTool = 4,         // a program called by this one failed
  kExitNoCurves = 5,     // everything worked, and there are no curves
  kExitInterrupted = 130
};

// The code of a failure after the command line was accepted.
ExitCode ExitCodeOf(const Status& status);

// Runs the word that comes first in `arguments`, which exclude the name of the
// program; flags without a word mean `reconstruct`, nothing at all `help`.
// Results go to stdout, progress and errors to stderr.
ExitCode RunProgram(const std::vector<std::string>& arguments);

}  // namespace curvix
