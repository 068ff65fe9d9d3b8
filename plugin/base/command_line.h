// SPDX-License-Identifier: BSD-3-Clause
// Flags in COLMAP's manner: snake_case, always with a value, `-h` the only
// short form, and a project file with the same names.
#pragma once

#include <curvix/status.h>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/option_table.h"

namespace curvix {

struct Flag {
  std::string name;                   // without the leading --
  std::string help;                   // one line
  std::string default_value = {};     // "": none
  std::string range = {};             // "> 0"; "": anything
  std::string unit = {};              // "px", "deg" or ""
  std::string symbol = {};            // of the paper, or ""
  std::optional<OptionRow> row = {};  // if RowFlag() or Switch() made it
  bool is_required = false;
  bool is_advanced = false;  // listed by --help_all only
  bool is_switch = false;    // `--json` means `--json=1`
  // Takes a value from the command line or the project file.
  // kInvalidArgument: a sentence that names the flag and what it allows.
  std::function<Status(const std::string& text)> set;
};

// Flags under one heading of the help text.
struct FlagSection {
  std::string title;
  std::vector<Flag> flags;
};

// Makers of flags. Pointers must outlive the flag; their values at this moment
// are the defaults shown.
Flag PathFlag(std::string name, std::filesystem::path* path, std::string help);
Flag TextFlag(std::string name, std::string* value, std::string help);
Flag RowFlag(const OptionRow& row);
Flag ChoiceFlag(std::string name,
                std::vector<std::string> choices,
                std::string* choice,
                std::string help);
// The same of enumerators; `choices` names them all, in their order.
template <typename Enum>
Flag EnumFlag(std::string name,
              const std::vector<std::string>& choices,
              Enum* choice,
              std::string help) {
  const auto text = std::make_shared<std::string>(
      choices.at(static_cast<std::size_t>(*choice)));
  Flag flag = ChoiceFlag(std::move(name), choices, text.get(), std::move(help));
  flag.set = [=, set_text = flag.set](const std::string& value) {
    const Status status = set_text(value);
    const auto place = std::ranges::find(choices, *text);
    *choice = static_cast<Enum>(place - choices.begin());
    return status;
  };
  return flag;
}
Flag Switch(std::string name, bool* value, std::string help);
Flag Required(Flag flag);
Flag Advanced(Flag flag);

// The rows of the option table, one section per struct of Options: advanced,
// but for the filter of curves and the number of threads.
std::vector<FlagSection> OptionSections(Options& options);

enum class Request { kRun, kHelp, kHelpAll };

// Sets the flags from `arguments` and from the project file that a flag named
// project_path points to; where both name a flag, `arguments` win. If
// `arguments` have a workspace_path, paths of the file that lie in its own
// workspace move into that one. Flags of `of_others` in the file are passed
// over. Flags are set in the order of `sections`, whatever the order of the
// arguments: a preset comes before what may change it. kHelp or kHelpAll, with
// nothing set, if -h, --help or --help_all is among the arguments. Errors name
// the flag, or the line and key of the project file, and for an unknown one the
// nearest that exists: kInvalidArgument, and kNotFound for a project file that
// is not there.
Result<Request> ParseFlags(const std::vector<std::string>& arguments,
                           const std::vector<FlagSection>& sections,
                           const std::vector<FlagSection>& of_others = {});

}  // namespace curvix
