// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/commands/commands.h"

#include <glog/logging.h>
#include <array>
#include <utility>

#include "base/file_io.h"
#include "colmap/files.h"
#include "colmap/project_file.h"
#include "plugin/base/suggestion.h"
#include "plugin/base/text.h"
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
                         .help = "1: libraries log to stderr; 0: to files in "
                                 "the temporary folder"})),
       Advanced(RowFlag({.name = "log_level",
                         .field = &settings->log_level,
                         .max = 4,
                         .help = "how much libraries log; 0: nothing"}))}};
}

ExitCode ExitCodeOf(const Status& status) {
  switch (status.code()) {
    case StatusCode::kOk:
      return kExitSuccess;
    case StatusCode::kInvalidArgument:
    case StatusCode::kNotFound:
    case StatusCode::kDataLoss:
    case StatusCode::kUnsupported:
      return kExitInput;
    case StatusCode::kExternalTool:
      return kExitTool;
    case StatusCode::kCancelled:
      return kExitInterrupted;
    case StatusCode::kInternal:
      return kExitInternal;
  }
  return kExitInternal;
}

Result<ExitCode> Help(const Arguments& arguments);
Result<ExitCode> Version(const Arguments& arguments);

std::string VersionText() {
  return "colmap_curvix " + std::string(ProgramVersion()) +
         " -- 3D curves from COLMAP reconstructions\n";
}

// In the order of the overview.
constexpr std::array kCommands = {
    Command{"reconstruct", "Images and poses in, curves out", RunReconstruct},
    Command{"partition",
            "Divide a large scene into parts for reconstruct --part",
            RunPartitionCommand},
    Command{"merge",
            "Put the reconstructed parts of a scene together",
            RunMergeCommand},
    Command{"align",
            "Give results scale and axes: from lengths, markers, positions",
            RunAlign},
    Command{"draw",
            "Elevations, plans and sections to scale: DXF and SVG",
            RunDraw},
    Command{"synthesize",
            "Write a small workspace with known curves, to try things",
            RunSynthesize},
    Command{"import",
            "Make a workspace of other data, or curves of other programs' "
            "lines",
            RunImport},
    Command{"evaluate",
            "Compare curves with known ones, or with images held out",
            RunEvaluate},
    Command{"help", "This overview; 'help <command>' explains one", Help},
    Command{"version", "The version of the program", Version},
};

constexpr char kExamples[] =
    "Examples\n"
    "  colmap_curvix --workspace_path proj\n"
    "      reads proj/sparse and proj/images, writes proj/curvix/0\n"
    "  colmap_curvix --workspace_path proj --preset paper\n"
    "      the method and the values of the paper throughout\n"
    "  colmap_curvix --workspace_path proj --Validation.max_angle_deg 10\n"
    "      one option of one stage\n"
    "  colmap_curvix --project_path proj/curvix/0/project.ini\n"
    "      repeats an earlier run\n";

Result<ExitCode> Help(const Arguments& arguments) {
  if (!arguments.empty() && !arguments.front().starts_with("-")) {
    return RunProgram({arguments.front(), "--help"});
  }
  bool markdown = false;
  const std::optional<ExitCode> code = ParseCommand(
      "help",
      arguments,
      {{"Output",
        {Switch("markdown",
                &markdown,
                "print docs/options.md, every option with its default")}}});
  if (code) return *code;
  if (markdown) {
    std::cout << OptionsMarkdown();
    return kExitSuccess;
  }
  std::cout << VersionText()
            << "\nUsage: colmap_curvix --workspace_path proj [options]\n"
               "       colmap_curvix <command> [options]\n\nCommands\n";
  for (const Command& command : kCommands) {
    std::string name = command.name;
    name.resize(13, ' ');
    std::cout << "  " << name << command.summary << "\n";
  }
  std::cout << "\n"
            << kExamples
            << "\n'colmap_curvix --help' lists the options that matter most, "
               "'--help_all' all of them.\n";
  return kExitSuccess;
}

Result<ExitCode> Version(const Arguments&) {
  std::cout << VersionText();
  return kExitSuccess;
}

ExitCode UnknownCommand(const std::string& name) {
  std::string message = "There is no command '" + name + "'";
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.push_back(command.name);
  message +=
      IsFolder(name)
          ? "; did you mean '--workspace_path " + name + "'?"
          : Suggestion(name, names, "", "'colmap_curvix help' lists all");
  return Fail(Status::InvalidArgument(message), kExitCommandLine);
}

// The value of a flag, "--name value" or "--name=value"; "" if it is not there.
std::string ValueOf(const Arguments& arguments, const std::string& flag) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == flag && i + 1 < arguments.size()) {
      return arguments[i + 1];
    }
    if (arguments[i].starts_with(flag + "=")) {
      return arguments[i].substr(flag.size() + 1);
    }
  }
  return "";
}

// What runs where no command is given: that of the project file, which
// ParseCommand reads again and complains about.
Command CommandOfProject(const Arguments& arguments) {
  Command command = kCommands.front();
  const Result<std::string> text =
      ReadFile(ValueOf(arguments, "--project_path"));
  if (!text.ok()) return command;
  const auto entries = ParseProjectFile(*text);
  if (!entries.ok()) return command;
  for (const ProjectEntry& entry : *entries) {
    if (entry.name != kCommandName) continue;
    const Command* const named = FindCommand(entry.value);
    if (named != nullptr) command = *named;
  }
  return command;
}

Result<ExitCode> RunWord(const Arguments& arguments) {
  if (arguments.empty()) return Help({});
  const std::string& first = arguments.front();
  if (first == "--version") return Version({});
  if (first.starts_with("-")) return CommandOfProject(arguments).run(arguments);
  const Command* const command = FindCommand(first);
  if (command == nullptr) return UnknownCommand(first);
  return command->run({arguments.begin() + 1, arguments.end()});
}

}  // namespace

const Command* FindCommand(const std::string& name) {
  for (const Command& command : kCommands) {
    if (name == command.name) return &command;
  }
  return nullptr;
}

ExitCode RunProgram(const std::vector<std::string>& arguments) {
  const Result<ExitCode> code = RunWord(arguments);
  return code.ok() ? *code : Fail(code.status());
}

ExitCode Fail(const Status& status, ExitCode code) {
  std::string message = status.message();
  if (message.empty() || (message.back() != '.' && message.back() != '?')) {
    message += '.';
  }
  std::cerr << "ERROR: " << ForTerminal(std::move(message)) << std::endl;
  return code;
}

ExitCode Fail(const Status& status) { return Fail(status, ExitCodeOf(status)); }

std::optional<ExitCode> ParseCommand(const std::string& name,
                                     const Arguments& arguments,
                                     std::vector<FlagSection> sections) {
  CommonSettings settings;
  sections.insert(sections.begin() + 1, CommonSection(&settings));
  // The project.ini of a run serves all commands.
  RunSettings run;
  std::vector<FlagSection> of_runs = ReconstructSections(&run);
  of_runs.front().flags.push_back(TextFlag(kCommandName, &run.command, ""));
  const Result<Request> request = ParseFlags(arguments, sections, of_runs);
  if (!request.ok()) {
    const bool is_file = request.status().code() == StatusCode::kNotFound;
    const ExitCode code =
        Fail(request.status(), is_file ? kExitInput : kExitCommandLine);
    std::cerr << "See 'colmap_curvix " << name << " --help'." << std::endl;
    return code;
  }
  if (*request != Request::kRun) {
    std::cout << HelpText("colmap_curvix " + name + " [options]",
                          FindCommand(name)->summary +
                              std::string(". 'colmap_curvix help' lists the "
                                          "other commands."),
                          sections,
                          *request == Request::kHelpAll);
    return kExitSuccess;
  }
  FLAGS_logtostderr = settings.log_to_stderr;
  FLAGS_v = settings.log_level;
  // Failures of Ceres are handled where it is called.
  FLAGS_minloglevel = settings.log_level > 0 ? google::INFO : google::FATAL;
  return std::nullopt;
}

}  // namespace curvix
