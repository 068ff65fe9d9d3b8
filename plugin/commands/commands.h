// SPDX-License-Identifier: BSD-3-Clause
// The commands of the program, `colmap_curvix <command> --flags`, and what they
// share.
#pragma once

#include <curvix/status.h>
#include <unistd.h>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "plugin/base/command_line.h"
#include "plugin/base/file_errors.h"
#include "plugin/base/progress.h"
#include "plugin/run/run_report.h"

namespace curvix {

// Runs the word that comes first in `arguments`, which exclude the name of the
// program; flags without a word mean `reconstruct`, nothing at all `help`.
// Results go to stdout, progress and errors to stderr.
ExitCode RunProgram(const std::vector<std::string>& arguments);

using Arguments = std::vector<std::string>;

// A word; `summary` is one line without a full stop.
struct Command {
  const char* name;
  const char* summary;
  // The status of a failure that Fail() is to tell.
  Result<ExitCode> (*run)(const Arguments& arguments);
};

Result<ExitCode> RunReconstruct(const Arguments& arguments);
Result<ExitCode> RunPartitionCommand(const Arguments& arguments);
Result<ExitCode> RunMergeCommand(const Arguments& arguments);
Result<ExitCode> RunAlign(const Arguments& arguments);
Result<ExitCode> RunDraw(const Arguments& arguments);
Result<ExitCode> RunSynthesize(const Arguments& arguments);
Result<ExitCode> RunImport(const Arguments& arguments);
Result<ExitCode> RunEvaluate(const Arguments& arguments);

// Where things are.
FlagSection PathsSection(RunSettings* settings);

// The number of threads.
FlagSection RuntimeSection(RunSettings* settings);

// What `reconstruct` can be told; the preset comes before what it changes.
std::vector<FlagSection> ReconstructSections(RunSettings* settings);

// f(progress), which is shown on stderr; kNotFound if the file system throws.
template <typename F>
auto WithProgress(const F& f) {
  ProgressPrinter progress(std::cerr, isatty(STDERR_FILENO) != 0);
  return CatchFileErrors([&] { return f(progress); });
}

// Does a job with its progress on stderr, and prints its closing words.
using Job = std::function<Result<RunRecord>(RunProgress& progress)>;
Result<ExitCode> RunAndSummarize(const RunSettings& settings, const Job& job);

// nullptr: there is no such word.
const Command* FindCommand(const std::string& name);

// Prints "ERROR: <message>." to stderr and returns `code`, or that of a failure
// after the command line was accepted.
ExitCode Fail(const Status& status, ExitCode code);
ExitCode Fail(const Status& status);

// Parses the flags of a word, in at least one section, to which those are added
// that every word has (project file, logging), and applies the latter. An exit
// code if that is all there is to do: help was asked for, or a flag is wrong.
std::optional<ExitCode> ParseCommand(const std::string& name,
                                     const Arguments& arguments,
                                     std::vector<FlagSection> sections);

}  // namespace curvix
