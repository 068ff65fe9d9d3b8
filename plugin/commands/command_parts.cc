// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/commands/command_parts.h"

#include <glog/logging.h>
#include <algorithm>
#include <cctype>
#include <iostream>

#include "plugin/commands/help_text.h"

namespace curvix {
namespace {

struct CommonSettings {
  std::filesystem::path project_path;
  bool log_to_stderr = true;
  int log_level = 0;
};

FlagSection CommonSection(CommonSettings* settings) {
  return {
      "General",
      {PathFlag("project_path",
                &settings->project_path,
                "file with name=value lines and [Section] headings; the "
                "command line wins"),
       Advanced(RowFlag({.name = "log_to_stderr",
                         .field = &settings->log_to_stderr,
                         .max = 1,
                         .help = "1: libraries log to stderr; 0: to files in "
                                 "the temporary folder"})),
       Advanced(RowFlag({.name = "log_level",
                         .field = &settings->log_level,
                         .max = 4,
                         .help = "how much libraries log"}))}};
}

}  // namespace

ExitCode Fail(const Status& status, ExitCode code) {
  std::string message = status.message();
  if (message.empty() || (message.back() != '.' && message.back() != '?')) {
    message += '.';
  }
  // Names come from files, and a terminal obeys control characters.
  std::replace_if(
      message.begin(),
      message.end(),
      [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; },
      '?');
  std::cerr << "ERROR: " << message << std::endl;
  return code;
}

std::optional<ExitCode> ParseCommand(const std::string& name,
                                     const Arguments& arguments,
                                     std::vector<FlagSection> sections) {
  CommonSettings settings;
  sections.insert(sections.begin() + 1, CommonSection(&settings));
  const Result<Request> request = ParseFlags(arguments, sections);
  if (!request.ok()) {
    const bool is_file = request.status().code() == StatusCode::kNotFound;
    const ExitCode code =
        Fail(request.status(), is_file ? kExitInput : kExitCommandLine);
    std::cerr << "See 'colmap_curvix " << name << " --help'." << std::endl;
    return code;
  }
  if (*request != Request::kRun) {
    std::cout << HelpText("colmap_curvix " + name + " [options]",
                          FindCommand(name)->summary + std::string("."),
                          sections,
                          *request == Request::kHelpAll);
    return kExitSuccess;
  }
  FLAGS_logtostderr = settings.log_to_stderr;
  FLAGS_v = settings.log_level;
  return std::nullopt;
}

}  // namespace curvix
