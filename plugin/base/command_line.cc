// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/command_line.h"

#include <boost/algorithm/string/join.hpp>
#include <boost/program_options.hpp>
#include <map>

#include "base/file_io.h"
#include "colmap/project_file.h"
#include "plugin/base/suggestion.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

// Of the command line, or of a line of the project file.
struct GivenValue {
  std::string text;
  std::size_t line = 0;  // from 1; 0: of the command line
};

using Values = std::map<std::string, GivenValue>;

std::vector<Flag> AllFlags(const std::vector<FlagSection>& sections) {
  std::vector<Flag> flags;
  for (const FlagSection& section : sections) {
    flags.insert(flags.end(), section.flags.begin(), section.flags.end());
  }
  return flags;
}

po::options_description Describe(const std::vector<Flag>& flags) {
  po::options_description description;
  description.add_options()("help,h", po::bool_switch())("help_all",
                                                         po::bool_switch());
  for (const Flag& flag : flags) {
    auto* value = po::value<std::string>();
    if (flag.is_switch) value->implicit_value("1");
    description.add_options()(flag.name.c_str(), value);
  }
  return description;
}

constexpr const char* kListsAll = "--help_all lists all options";

Status UnknownFlag(std::string token, const std::vector<Flag>& flags) {
  token = token.substr(0, token.find('='));
  const std::size_t dashes = token.find_first_not_of('-');
  const std::string name =
      dashes == std::string::npos ? token : token.substr(dashes);
  std::vector<std::string> names = {"help", "help_all"};
  for (const Flag& flag : flags) names.push_back(flag.name);
  return Status::InvalidArgument("There is no option '" + token + "'" +
                                 Suggestion(name, names, "--", kListsAll));
}

// As project files have it: "'sigma_px' in [EdgeDetection]".
std::string KeyText(const std::string& name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return "'" + name + "'";
  return "'" + name.substr(dot + 1) + "' in [" + name.substr(0, dot) + "]";
}

Status UnknownKey(const std::string& name, const std::vector<Flag>& flags) {
  std::vector<std::string> names;
  for (const Flag& flag : flags) names.push_back(flag.name);
  const std::string nearest = NearestName(name, names);
  return Status::InvalidArgument(
      "There is no option " + KeyText(name) +
      (nearest.empty() ? "; " + std::string(kListsAll)
                       : "; did you mean " + KeyText(nearest) + "?"));
}

Status InLine(const fs::path& file, std::size_t line, const Status& status) {
  return {status.code(),
          file.string() + ", line " + std::to_string(line) + ": " +
              status.message()};
}

// What Boost found, as one value per name.
Result<Values> Collect(const po::parsed_options& parsed,
                       const std::vector<Flag>& flags) {
  Values values;
  for (const po::option& option : parsed.options) {
    const std::string token = option.original_tokens.empty()
                                  ? option.string_key
                                  : option.original_tokens.front();
    if (option.position_key >= 0) {
      return Status::InvalidArgument(
          "'" + token + "' is not expected here; options start with --");
    }
    if (option.unregistered) return UnknownFlag(token, flags);
    // Only a switch may come without a value.
    const std::string value = option.value.empty() ? "1" : option.value.front();
    if (!values.emplace(option.string_key, GivenValue{value}).second) {
      return Status::InvalidArgument("The option '--" + option.string_key +
                                     "' is given twice");
    }
  }
  return values;
}

Result<Values> ReadArguments(const std::vector<std::string>& arguments,
                             const std::vector<Flag>& flags) {
  using Style = po::command_line_style::style_t;
  const int style =
      Style::unix_style & ~Style::allow_guessing & ~Style::allow_sticky;
  const po::options_description description = Describe(flags);
  try {
    return Collect(po::command_line_parser(arguments)
                       .options(description)
                       .style(style)
                       .allow_unregistered()
                       .run(),
                   flags);
  } catch (const po::error& error) {
    return Status::InvalidArgument(error.what());
  }
}

bool IsFlag(const std::string& name, const std::vector<Flag>& flags) {
  return std::ranges::find(flags, name, &Flag::name) != flags.end();
}

// One value per name, without flags of others.
Result<Values> ReadProjectFile(const fs::path& path,
                               const std::vector<Flag>& flags,
                               const std::vector<Flag>& of_others) {
  CURVIX_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  const Result<std::vector<ProjectEntry>> entries = ParseProjectFile(text);
  if (!entries.ok()) {
    return Status::InvalidArgument(path.string() + ", " +
                                   entries.status().message());
  }
  Values values;
  for (const ProjectEntry& entry : *entries) {
    if (!IsFlag(entry.name, flags)) {
      if (IsFlag(entry.name, of_others)) continue;
      return InLine(path, entry.line, UnknownKey(entry.name, flags));
    }
    const auto [given, is_new] =
        values.emplace(entry.name, GivenValue{entry.value, entry.line});
    if (!is_new) {
      return InLine(
          path,
          entry.line,
          Status::InvalidArgument(KeyText(entry.name) +
                                  " is given twice, first in line " +
                                  std::to_string(given->second.line)));
    }
  }
  return values;
}

// The options of a project file win over a preset, so another one would do
// nothing.
Status CheckPreset(const Values& given, const Values& project) {
  const auto preset = given.find("preset");
  const auto of_project = project.find("preset");
  if (preset == given.end() || of_project == project.end() ||
      preset->second.text == of_project->second.text) {
    return {};
  }
  return Status::InvalidArgument(
      "--preset " + preset->second.text + " would not change the options of " +
      given.at("project_path").text + ", which are those of --preset " +
      of_project->second.text + "; leave one of the two out");
}

// A workspace that is given wins over that of a project file, whose paths in
// its own workspace are then the same places in the given one: results move
// with their workspace.
void MoveIntoWorkspace(const fs::path& given, Values* project) {
  const auto workspace = project->find("workspace_path");
  if (workspace == project->end()) return;
  const fs::path own = fs::path(workspace->second.text).lexically_normal();
  for (auto& [name, value] : *project) {
    if (!name.ends_with("_path")) continue;
    const fs::path place =
        fs::path(value.text).lexically_normal().lexically_relative(own);
    if (!place.empty() && *place.begin() != "..") {
      value.text = (given / place).string();
    }
  }
}

Status SetFlags(const std::vector<Flag>& flags, const Values& values) {
  for (const Flag& flag : flags) {
    const auto value = values.find(flag.name);
    if (value == values.end()) continue;
    const auto& [text, line] = value->second;
    const Status status = flag.set(text);
    if (status.ok()) continue;
    if (line == 0) return status;
    return InLine(values.at("project_path").text, line, status);
  }
  return {};
}

Status CheckRequired(const std::vector<Flag>& flags, const Values& values) {
  for (const Flag& flag : flags) {
    if (flag.is_required && !values.contains(flag.name)) {
      return Status::InvalidArgument("The option '--" + flag.name +
                                     "' is required but missing");
    }
  }
  return {};
}

// Its value is the text.
template <typename Value>
Flag PlainFlag(std::string name,
               Value* value,
               std::string default_value,
               std::string help) {
  return {.name = std::move(name),
          .help = std::move(help),
          .default_value = std::move(default_value),
          .set = [value](const std::string& text) {
            *value = text;
            return Status();
          }};
}

}  // namespace

Flag PathFlag(std::string name, fs::path* path, std::string help) {
  return PlainFlag(std::move(name), path, path->string(), std::move(help));
}

Flag TextFlag(std::string name, std::string* value, std::string help) {
  return PlainFlag(std::move(name), value, *value, std::move(help));
}

Flag RowFlag(const OptionRow& row) {
  return {
      .name = FullName(row),
      .help = row.help,
      .default_value = ValueText(row),
      .range = RangeText(row),
      .unit = row.unit,
      .symbol = row.symbol,
      .row = row,
      .set = [row](const std::string& text) { return SetFromText(row, text); }};
}

Flag ChoiceFlag(std::string name,
                std::vector<std::string> choices,
                std::string* choice,
                std::string help) {
  Flag flag;
  flag.name = std::move(name);
  flag.help = std::move(help);
  flag.default_value = *choice;
  flag.range = boost::algorithm::join(choices, ", ");
  flag.set = [choice,
              choices = std::move(choices),
              name = flag.name,
              range = flag.range](const std::string& text) -> Status {
    if (std::ranges::find(choices, text) == choices.end()) {
      return Status::InvalidArgument(name + " is " +
                                     (text.empty() ? "empty" : text) +
                                     "; it must be one of " + range);
    }
    *choice = text;
    return {};
  };
  return flag;
}

Flag Switch(std::string name, bool* value, std::string help) {
  Flag flag = RowFlag(
      {.name = std::move(name), .field = value, .help = std::move(help)});
  flag.is_switch = true;
  return flag;
}

Flag Required(Flag flag) {
  flag.is_required = true;
  return flag;
}

Flag Advanced(Flag flag) {
  flag.is_advanced = true;
  return flag;
}

std::vector<FlagSection> OptionSections(Options& options) {
  std::vector<FlagSection> sections;
  for (const OptionRow& row : OptionTable(options)) {
    const std::string title = row.section.empty() ? "Runtime" : row.section;
    if (sections.empty() || sections.back().title != title) {
      sections.push_back({title, {}});
    }
    const bool is_everyday = title == "CurveFilter" || title == "Runtime";
    sections.back().flags.push_back(is_everyday ? RowFlag(row)
                                                : Advanced(RowFlag(row)));
  }
  return sections;
}

Result<Request> ParseFlags(const std::vector<std::string>& arguments,
                           const std::vector<FlagSection>& sections,
                           const std::vector<FlagSection>& of_others) {
  for (const std::string& token : arguments) {
    if (token == "--help_all") return Request::kHelpAll;
    if (token == "-h" || token == "--help") return Request::kHelp;
  }
  const std::vector<Flag> flags = AllFlags(sections);
  CURVIX_ASSIGN_OR_RETURN(Values values, ReadArguments(arguments, flags));
  const auto project = values.find("project_path");
  if (project != values.end()) {
    CURVIX_ASSIGN_OR_RETURN(
        Values more,
        ReadProjectFile(project->second.text, flags, AllFlags(of_others)));
    CURVIX_RETURN_IF_ERROR(CheckPreset(values, more));
    const auto workspace = values.find("workspace_path");
    if (workspace != values.end()) {
      MoveIntoWorkspace(workspace->second.text, &more);
    }
    values.merge(more);  // keeps what is there already
  }
  CURVIX_RETURN_IF_ERROR(CheckRequired(flags, values));
  CURVIX_RETURN_IF_ERROR(SetFlags(flags, values));
  return Request::kRun;
}

}  // namespace curvix
