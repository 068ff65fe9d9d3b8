// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/commands/help_text.h"

#include <algorithm>

#include "plugin/poses/pose_refinement.h"
#include "plugin/run/text.h"

namespace curvix {
namespace {

constexpr std::size_t kRangeColumn = 52;

// "  --EdgeDetection.sigma_px arg (=1)"
std::string FlagHead(const Flag& flag) {
  std::string head = "  --" + flag.name;
  if (flag.is_switch) return head;
  head += " arg";
  if (flag.is_required) return head + " (required)";
  if (flag.default_value.empty()) return head;
  return head + " (=" + flag.default_value + ")";
}

// `allowed` in a column of its own, or wherever there is room for it.
std::string WithRange(std::string head, const std::string& allowed) {
  head += "  ";
  if (head.size() + allowed.size() > kColumns) {
    head.resize(head.size() - 2);
    return head + "\n" + std::string(kRangeColumn, ' ') + allowed + "\n";
  }
  head.resize(std::max(head.size(), kRangeColumn), ' ');
  return head + allowed + "\n";
}

std::string FlagHelp(const Flag& flag) {
  std::string allowed = flag.is_switch ? "" : flag.range;
  if (!allowed.empty() && !flag.unit.empty()) allowed += " " + flag.unit;
  const bool is_list = allowed.size() > kColumns - kRangeColumn;
  std::string text = FlagHead(flag);
  text = allowed.empty() || is_list ? text + "\n" : WithRange(text, allowed);
  std::string symbol = flag.symbol.empty() ? "" : "(" + flag.symbol + ")";
  std::replace(symbol.begin(), symbol.end(), ' ', kNoBreak);
  text += WrapText(flag.help + " " + symbol, 6);
  return is_list ? text + WrapText("one of: " + allowed, 6) : text;
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

// A table of flags that the option table does not have.
std::string MarkdownTable(const FlagSection& section) {
  std::string text = "\n## " + section.title +
                     "\n\n"
                     "| option | default | range | unit | meaning |\n"
                     "|---|---|---|---|---|\n";
  for (const Flag& flag : section.flags) {
    text += "| `--" + flag.name + "` |";
    for (const std::string& cell :
         {flag.default_value, flag.range, flag.unit, flag.help}) {
      text += " " + (cell.empty() ? std::string("–") : cell) + " |";
    }
    text += "\n";
  }
  return text;
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
                     const std::vector<FlagSection>& sections,
                     bool with_advanced) {
  std::string text = "Usage: " + usage + "\n\n" + WrapText(summary, 0);
  int num_left_out = 0;
  for (const FlagSection& section : sections) {
    std::string flags;
    for (const Flag& flag : section.flags) {
      const bool is_shown = with_advanced || !flag.is_advanced;
      if (is_shown) flags += FlagHelp(flag);
      if (!is_shown) ++num_left_out;
    }
    if (!flags.empty()) text += "\n" + section.title + "\n" + flags;
  }
  if (num_left_out == 0) return text;
  return text + "\n'--help_all' lists " + std::to_string(num_left_out) +
         " more options.\n";
}

std::string OptionsMarkdown() {
  Options options;
  Options paper = PaperOptions();
  const std::vector<OptionRow> rows = OptionTable(options);
  const std::vector<OptionRow> paper_rows = OptionTable(paper);
  PoseRefinementSettings poses;
  std::string text = kMarkdownHead + MarkdownTable(PoseRefinementFlags(&poses));
  std::string previous = "-";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t dot = rows[i].name.find('.');
    const std::string section =
        dot == std::string::npos ? "Runtime" : rows[i].name.substr(0, dot);
    if (section != previous) {
      text += "\n## " + section + "\n\n" + kMarkdownTable;
    }
    previous = section;
    text += MarkdownRow(rows[i], paper_rows[i]);
  }
  return text;
}

}  // namespace curvix
