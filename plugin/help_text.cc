// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/help_text.h"

#include <sstream>

namespace curvix {
namespace {

constexpr std::size_t kColumns = 80;

// `text` broken between words, every line after `indent` spaces.
std::string Wrap(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  std::string wrapped;
  std::string line;
  for (std::string word; words >> word;) {
    if (!line.empty() && indent + line.size() + 1 + word.size() > kColumns) {
      wrapped += std::string(indent, ' ') + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return wrapped + std::string(indent, ' ') + line + "\n";
}

std::string Allowed(const Flag& flag) {
  if (flag.range.empty() || flag.unit.empty()) return flag.range;
  return flag.range + " " + flag.unit;
}

std::string FlagHelp(const Flag& flag) {
  std::string head = "  --" + flag.name;
  if (!flag.is_switch) head += " arg";
  if (flag.is_required) head += " (required)";
  if (!flag.default_value.empty() && !flag.is_switch) {
    head += " (=" + flag.default_value + ")";
  }
  const std::string allowed = flag.is_switch ? "" : Allowed(flag);
  constexpr std::size_t kRangeColumn = 52;
  if (!allowed.empty() && head.size() + 2 <= kRangeColumn &&
      kRangeColumn + allowed.size() <= kColumns) {
    head.resize(kRangeColumn, ' ');
    head += allowed;
  } else if (!allowed.empty()) {
    head += "\n" + std::string(kRangeColumn, ' ');
    head = kRangeColumn + allowed.size() <= kColumns
               ? head + allowed
               : head.substr(0, head.find('\n')) + "\n      " + allowed;
  }
  std::string help = flag.help;
  if (!flag.symbol.empty()) help += " (" + flag.symbol + ")";
  return head + "\n" + Wrap(help, 6);
}

std::string MarkdownRow(const OptionRow& row, const OptionRow& paper) {
  const std::string value = ValueText(row);
  const std::string paper_value = ValueText(paper);
  const auto or_dash = [](const std::string& text) {
    return text.empty() ? std::string("–") : text;
  };
  return "| `--" + row.name + "` | " + value + " | " +
         (paper_value == value ? "same" : paper_value) + " | " +
         RangeText(row) + " | " + or_dash(row.unit) + " | " +
         or_dash(row.symbol) + " | " + row.help + " |\n";
}

constexpr char kMarkdownHead[] =
    "# Options\n"
    "\n"
    "<!-- Written by `colmap_curvix help --markdown`; a test compares. -->\n"
    "\n"
    "Every option of the reconstruction, stage by stage in the order of the\n"
    "paper. Give them on the command line (`--Validation.max_angle_deg 10`) "
    "or\n"
    "in a project file (`--project_path x.ini`):\n"
    "\n"
    "```ini\n"
    "workspace_path=proj\n"
    "[Validation]\n"
    "max_angle_deg=10\n"
    "```\n"
    "\n"
    "The command line wins over the project file, and both over `--preset`.\n"
    "*Paper* is the value with `--preset paper`. Pixels are those of the\n"
    "original images.\n";

constexpr char kMarkdownTable[] =
    "| option | default | paper | range | unit | in the paper | meaning |\n"
    "|---|---|---|---|---|---|---|\n";

}  // namespace

std::string HelpText(const std::string& usage,
                     const std::string& summary,
                     const std::vector<FlagSection>& sections) {
  std::string text = "Usage: " + usage + "\n\n" + Wrap(summary, 0);
  for (const FlagSection& section : sections) {
    text += "\n" + section.title + "\n";
    for (const Flag& flag : section.flags) text += FlagHelp(flag);
  }
  return text;
}

std::string OptionsMarkdown() {
  Options options;
  Options paper = PaperOptions();
  const std::vector<OptionRow> rows = OptionTable(options);
  const std::vector<OptionRow> paper_rows = OptionTable(paper);
  std::string text = kMarkdownHead;
  std::string previous = "-";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t dot = rows[i].name.find('.');
    const std::string section =
        dot == std::string::npos ? "Runtime" : rows[i].name.substr(0, dot);
    if (section != previous)
      text += "\n## " + section + "\n\n" + kMarkdownTable;
    previous = section;
    text += MarkdownRow(rows[i], paper_rows[i]);
  }
  return text;
}

}  // namespace curvix
