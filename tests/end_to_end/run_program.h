// SPDX-License-Identifier: BSD-3-Clause
// Programs as a person calls them, and what they leave in a folder.
#pragma once

#include <sys/wait.h>

#include <gtest/gtest.h>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

namespace curvix {

// The exit code of scripts that miss what they need.
inline constexpr int kNotInstalled = 77;

struct Outcome {
  int exit_code = -1;  // -1: ended by a signal
  std::string output;  // stdout
};

inline Outcome RunInShell(const std::string& command) {
  Outcome outcome;
  FILE* const pipe = popen(command.c_str(), "r");
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) {
    outcome.output += static_cast<char>(c);
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  return outcome;
}

// Runs the program of the project; `arguments` as in a shell. The output is
// that to stdout and stderr.
inline Outcome RunProgram(const std::string& arguments) {
  return RunInShell(std::string("'") + CURVIX_PROGRAM + "' " + arguments +
                    " 2>&1");
}

// Whether there is an error in what the program says. It begins with a capital,
// or the name of an option, a file or a command.
inline bool HasError(const std::string& output) {
  static const std::regex small(
      "ERROR: (a|another|cannot|give|no|none|the|there|these|this) ");
  EXPECT_FALSE(std::regex_search(output, small)) << output;
  return output.find("ERROR: ") != output.npos;
}

inline std::string Quoted(const std::filesystem::path& path) {
  return "'" + path.string() + "'";
}

// A file of the repository.
inline std::string Source(const std::string& path) {
  return std::string(CURVIX_SOURCE_DIR) + "/" + path;
}

inline std::string Read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Every file below `folder` and what is in it; links are not followed.
inline std::map<std::string, std::string> Contents(
    const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::map<std::string, std::string> contents;
  if (!fs::exists(folder)) return contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (entry.is_symlink()) {
      contents[name] = "link to " + fs::read_symlink(entry.path()).string();
    } else {
      contents[name] = entry.is_regular_file() ? Read(entry.path()) : "folder";
    }
  }
  return contents;
}

}  // namespace curvix
