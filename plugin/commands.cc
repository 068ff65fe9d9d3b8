// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/commands.h"

#include <glog/logging.h>
#include <unistd.h>

#include <array>
#include <iostream>
#include <optional>
#include <utility>

#include "plugin/command_line.h"
#include "plugin/help_text.h"
#include "plugin/progress.h"
#include "plugin/run_workspace.h"

namespace curvix {
namespace {

using Arguments = std::vector<std::string>;

struct Command {
  const char* name;
  const char* help;  // one line, without a full stop
  ExitCode (*run)(const Arguments& arguments);
};

ExitCode Reconstruct(const Arguments& arguments);
ExitCode Help(const Arguments& arguments);
ExitCode Version(const Arguments& arguments);

// In the order of the overview.
constexpr std::array kCommands = {
    Command{"reconstruct",
            "Photographs and poses in, curves out: the whole job",
            Reconstruct},
    Command{"help", "This overview; help <command> explains one", Help},
    Command{"version", "The version of the program", Version},
};

const Command* FindCommand(const std::string& name) {
  for (const Command& command : kCommands) {
    if (name == command.name) return &command;
  }
  return nullptr;
}

ExitCode Fail(const Status& status, ExitCode code) {
  std::string message = status.message();
  if (message.empty() || (message.back() != '.' && message.back() != '?')) {
    message += '.';
  }
  std::cerr << "ERROR: " << message << std::endl;
  return code;
}

// Flags that every word has.
class CommonFlags {
 public:
  FlagSection Section() {
    OptionRow level;
    level.name = "log_level";
    level.field = &log_level_;
    level.max = 4;
    level.help = "how much libraries log";
    OptionRow to_stderr;
    to_stderr.name = "log_to_stderr";
    to_stderr.field = &log_to_stderr_;
    to_stderr.max = 1;
    to_stderr.help = "log to stderr instead of files in the temporary folder";
    return {"General",
            {PathFlag("project_path",
                      &project_path_,
                      "file with name=value lines and [Section] headings; the "
                      "command line wins"),
             RowFlag(to_stderr),
             RowFlag(level)}};
  }
  void Apply() const {
    FLAGS_logtostderr = log_to_stderr_;
    FLAGS_v = log_level_;
  }

 private:
  std::filesystem::path project_path_;
  bool log_to_stderr_ = true;
  int log_level_ = 0;
};

// Parses the flags of a command; they come before the common ones. An exit
// code if that is all there is to do: help was asked for, or a flag is wrong.
std::optional<ExitCode> Parse(const std::string& command,
                              const Arguments& arguments,
                              std::vector<FlagSection> sections) {
  CommonFlags common;
  sections.push_back(common.Section());
  const Result<Request> request = ParseFlags(arguments, sections);
  if (!request.ok()) {
    const ExitCode code = Fail(request.status(), kExitCommandLine);
    std::cerr << "See 'colmap_curvix " << command << " --help'." << std::endl;
    return code;
  }
  if (*request == Request::kHelp) {
    std::cout << HelpText("colmap_curvix " + command + " [options]",
                          FindCommand(command)->help + std::string("."),
                          sections);
    return kExitSuccess;
  }
  common.Apply();
  return std::nullopt;
}

// Replaces the options, threads apart: comes before the flags of the table.
Flag PresetFlag(RunSettings* settings) {
  Flag flag = ChoiceFlag("preset",
                         {"default", "paper"},
                         &settings->preset,
                         "values that the options below start from: the best "
                         "known, or the method of the paper throughout");
  flag.set = [settings, choose = flag.set](const std::string& text) {
    Status status = choose(text);
    if (!status.ok()) return status;
    const RuntimeOptions runtime = settings->options.runtime;
    settings->options = text == "paper" ? PaperOptions() : Options();
    settings->options.runtime = runtime;
    return status;
  };
  return flag;
}

std::vector<FlagSection> ReconstructSections(RunSettings* settings) {
  std::vector<FlagSection> sections = {
      {"Paths",
       {Required(PathFlag("workspace_path",
                          &settings->workspace_path,
                          "folder with sparse/ and images/, or dense/")),
        PathFlag("input_path",
                 &settings->input_path,
                 "folder of the model, when it is not sparse/0, sparse or "
                 "dense/0/sparse"),
        PathFlag("image_path",
                 &settings->image_path,
                 "folder of the images, when it is not images/ beside the "
                 "model"),
        PathFlag("output_path",
                 &settings->output_path,
                 "folder of the results, when it is not to be curvix/0 beside "
                 "sparse/0")}},
      {"Method", {PresetFlag(settings)}}};
  for (FlagSection& section : OptionSections(settings->options)) {
    sections.push_back(std::move(section));
  }
  return sections;
}

ExitCode Reconstruct(const Arguments& arguments) {
  RunSettings settings;
  const std::optional<ExitCode> code =
      Parse("reconstruct", arguments, ReconstructSections(&settings));
  if (code) return *code;
  const Status valid = Validate(settings.options);
  if (!valid.ok()) return Fail(valid, kExitCommandLine);

  Result<RunRecord> record = Status();
  {
    ProgressPrinter progress(std::cerr, isatty(STDERR_FILENO) != 0);
    record = RunWorkspace(settings, progress);
  }
  if (!record.ok()) return Fail(record.status(), ExitCodeOf(record.status()));
  const bool is_empty = record->result.num_curves == 0;
  (is_empty ? std::cerr : std::cout) << "\n" << SummaryText(*record);
  return is_empty ? kExitNoCurves : kExitSuccess;
}

constexpr char kExamples[] =
    "Examples\n"
    "  colmap_curvix --workspace_path proj\n"
    "      reads proj/sparse/0 and proj/images, writes proj/curvix/0\n"
    "  colmap_curvix --workspace_path proj --preset paper\n"
    "      the method of the paper, word by word\n"
    "  colmap_curvix --workspace_path proj --Validation.max_angle_deg 10\n"
    "      one option of one stage; --help lists all\n"
    "  colmap_curvix --project_path proj/curvix/0/project.ini\n"
    "      repeats an earlier run\n";

ExitCode Help(const Arguments& arguments) {
  if (!arguments.empty() && FindCommand(arguments.front()) != nullptr) {
    return RunProgram({arguments.front(), "--help"});
  }
  bool markdown = false;
  const std::optional<ExitCode> code =
      Parse("help",
            arguments,
            {{"Output",
              {Switch("markdown",
                      &markdown,
                      "print docs/options.md, every option in a table")}}});
  if (code) return *code;
  if (markdown) {
    std::cout << OptionsMarkdown();
    return kExitSuccess;
  }
  Version({});
  std::cout << "\nUsage: colmap_curvix --workspace_path proj [options]\n"
               "       colmap_curvix <command> [options]\n\nCommands\n";
  for (const Command& command : kCommands) {
    std::string name = command.name;
    name.resize(13, ' ');
    std::cout << "  " << name << command.help << "\n";
  }
  std::cout << "\n" << kExamples;
  return kExitSuccess;
}

ExitCode Version(const Arguments&) {
  std::cout << "colmap_curvix " << ProgramVersion()
            << " -- 3D curves from COLMAP reconstructions\n";
  return kExitSuccess;
}

ExitCode UnknownCommand(const std::string& name) {
  std::string message = "There is no command '" + name + "'";
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.push_back(command.name);
  const std::string nearest = NearestName(name, names);
  if (!nearest.empty()) {
    message += "; did you mean '" + nearest + "'?";
  } else if (std::filesystem::exists(name)) {
    message += "; did you mean '--workspace_path " + name + "'?";
  } else {
    message += "; 'colmap_curvix help' lists all";
  }
  return Fail({StatusCode::kInvalidArgument, message}, kExitCommandLine);
}

}  // namespace

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

ExitCode RunProgram(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return Help({});
  const std::string& first = arguments.front();
  if (first == "--version") return Version({});
  if (first.starts_with("-")) return Reconstruct(arguments);
  const Command* const command = FindCommand(first);
  if (command == nullptr) return UnknownCommand(first);
  return command->run({arguments.begin() + 1, arguments.end()});
}

}  // namespace curvix
