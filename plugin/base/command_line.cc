// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/command_line.h"

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/join.hpp>
#include <boost/program_options.hpp>
#include <map>

#include "base/file_io.h"
#include "colmap/project_file.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

using Values = std::map<std::string, std::string>;

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

// Options of earlier versions that are constants now, and their values.
const Values& FormerOptions() {
  static const Values options = {{"EdgeDetection.border_px", "4"},
                                 {"EdgeDetection.short_contour_factor", "2"},
                                 {"CurveGrowth.min_relative_evidence", "0.3"},
                                 {"CurveGrowth.max_gap_px", "10"},
                                 {"CurveRefinement.max_junction_gap_px", "1.5"},
                                 {"CurveFitting.common_error_px", "0.1"}};
  return options;
}

Status UnknownFlag(std::string token, const std::vector<Flag>& flags) {
  token = token.substr(0, token.find('='));
  const std::size_t dashes = token.find_first_not_of('-');
  const std::string name =
      dashes == std::string::npos ? token : token.substr(dashes);
  const auto former = FormerOptions().find(name);
  if (former != FormerOptions().end()) {
    return Status::InvalidArgument("'" + token +
                                   "' is no longer an option; it is always " +
                                   former->second);
  }
  std::vector<std::string> names = {"help", "help_all"};
  for (const Flag& flag : flags) names.push_back(flag.name);
  return Status::InvalidArgument(
      "There is no option '" + token + "'" +
      Suggestion(name, names, "--", "--help_all lists all options"));
}

Status GivenTwice(const std::string& name) {
  return Status::InvalidArgument("The option '--" + name + "' is given twice");
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
    if (!values.emplace(option.string_key, value).second) {
      return GivenTwice(option.string_key);
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

// The entries as one value per name, without former options that have their
// constants and flags of others.
Result<Values> Collect(std::vector<ProjectEntry> entries,
                       const std::vector<Flag>& flags,
                       const std::vector<Flag>& of_others) {
  Values values;
  for (ProjectEntry& entry : entries) {
    const auto former = FormerOptions().find(entry.name);
    if (former != FormerOptions().end() && entry.value == former->second) {
      continue;
    }
    if (!IsFlag(entry.name, flags)) {
      if (IsFlag(entry.name, of_others)) continue;
      return UnknownFlag(entry.name, flags);
    }
    if (!values.emplace(entry.name, std::move(entry.value)).second) {
      return GivenTwice(entry.name);
    }
  }
  return values;
}

Result<Values> ReadProjectFile(const fs::path& path,
                               const std::vector<Flag>& flags,
                               const std::vector<Flag>& of_others) {
  CURVIX_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  Result<std::vector<ProjectEntry>> entries = ParseProjectFile(text);
  Result<Values> values = entries.ok()
                              ? Collect(*std::move(entries), flags, of_others)
                              : Result<Values>(entries.status());
  if (values.ok()) return values;
  return Status::InvalidArgument(values.status().message() + " (in " +
                                 path.string() + ")");
}

// The options of a project file win over a preset, so another one would do
// nothing.
Status CheckPreset(const Values& given, const Values& project) {
  const auto preset = given.find("preset");
  const auto of_project = project.find("preset");
  if (preset == given.end() || of_project == project.end() ||
      preset->second == of_project->second) {
    return {};
  }
  return Status::InvalidArgument(
      "--preset " + preset->second + " would not change the options of " +
      given.at("project_path") + ", which are those of --preset " +
      of_project->second + "; leave one of the two out");
}

// A workspace that is given wins over that of a project file, whose paths in
// its own workspace are then the same places in the given one: results move
// with their workspace.
void MoveIntoWorkspace(const fs::path& given, Values* project) {
  const auto workspace = project->find("workspace_path");
  if (workspace == project->end()) return;
  const fs::path own = fs::path(workspace->second).lexically_normal();
  for (auto& [name, value] : *project) {
    if (!name.ends_with("_path")) continue;
    const fs::path place =
        fs::path(value).lexically_normal().lexically_relative(own);
    if (!place.empty() && *place.begin() != "..") {
      value = (given / place).string();
    }
  }
}

Status SetFlags(const std::vector<Flag>& flags, const Values& values) {
  for (const Flag& flag : flags) {
    const auto value = values.find(flag.name);
    if (value == values.end()) continue;
    CURVIX_RETURN_IF_ERROR(flag.set(value->second));
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

// Levenshtein's distance.
std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1] ? 1 : 0);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

// "Section.name" in lower case; "section." and "name" of it.
struct SplitName {
  std::string whole, section, field;

  explicit SplitName(const std::string& name)
      : whole(boost::algorithm::to_lower_copy(name)) {
    const std::size_t begin = whole.find('.') + 1;
    section = whole.substr(0, begin);
    field = whole.substr(begin);
  }
};

// The candidate nearest to `name`; "": none is near.
std::string NearestName(const std::string& name,
                        const std::vector<std::string>& candidates) {
  std::string nearest;
  const SplitName wanted(name);
  // At most a third of the letters may differ.
  std::pair<std::size_t, std::size_t> least(
      std::max<std::size_t>(2, name.size() / 3) + 1, 0);
  for (const std::string& candidate : candidates) {
    const SplitName known(candidate);
    std::size_t distance = std::min(EditDistance(wanted.whole, known.whole),
                                    EditDistance(wanted.field, known.field));
    if (wanted.field.size() > 2 && known.field.starts_with(wanted.field)) {
      distance = std::min<std::size_t>(distance, 1);
    }
    const std::pair rating(distance,
                           EditDistance(wanted.section, known.section));
    if (rating < least) {
      least = rating;
      nearest = candidate;
    }
  }
  return nearest;
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
      .name = row.name,
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
      return Status::InvalidArgument(name + " is " + text +
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
    const std::size_t dot = row.name.find('.');
    const std::string title =
        dot == std::string::npos ? "Runtime" : row.name.substr(0, dot);
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
        ReadProjectFile(project->second, flags, AllFlags(of_others)));
    CURVIX_RETURN_IF_ERROR(CheckPreset(values, more));
    const auto workspace = values.find("workspace_path");
    if (workspace != values.end()) {
      MoveIntoWorkspace(workspace->second, &more);
    }
    values.merge(more);  // keeps what is there already
  }
  CURVIX_RETURN_IF_ERROR(CheckRequired(flags, values));
  CURVIX_RETURN_IF_ERROR(SetFlags(flags, values));
  return Request::kRun;
}

std::string Suggestion(const std::string& name,
                       const std::vector<std::string>& candidates,
                       const std::string& prefix,
                       const std::string& otherwise) {
  const std::string nearest = NearestName(name, candidates);
  return nearest.empty() ? "; " + otherwise
                         : "; did you mean '" + prefix + nearest + "'?";
}

}  // namespace curvix
