// SPDX-License-Identifier: BSD-3-Clause
// Runs another program, without a shell, and outlives it whatever it does.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace curvix {

struct ChildProcess {
  std::filesystem::path program;       // absolute
  std::vector<std::string> arguments;  // without the program's name
  std::filesystem::path folder;        // the child's current folder
  std::filesystem::path log_path;      // takes its stdout and stderr, together
  double timeout_s = 0;
  // Asked some twenty times a second; false ends the child.
  std::function<bool()> keep_going;
  // NAME=value, in place of what this process has under these names.
  std::vector<std::string> environment = {};
};

struct ChildEnd {
  enum class Kind { kExited, kKilled, kTimedOut, kStopped };
  Kind kind = Kind::kExited;
  int code = 0;  // exit code, or number of the signal that killed it
};

// Runs `child` to its end: its own, the time limit's, or that of keep_going.
// The child has no input, the default signal handlers and a process group of
// its own, of which nothing is left running afterwards. kExternalTool: it
// cannot be started, with the system's reason.
Result<ChildEnd> RunChildProcess(const ChildProcess& child);

// The program `name` in the first folder of $PATH that has it, as an absolute
// path; empty: in none.
std::filesystem::path FindInPath(const std::string& name);

// Whether `path` is a file that may be executed.
bool IsProgram(const std::filesystem::path& path);

}  // namespace curvix
