// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/commands/help_text.h"

#include <algorithm>

#include "plugin/base/text.h"
#include "plugin/poses/pose_refinement.h"

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
  std::ranges::replace(symbol, ' ', kNoBreak);
  text += WrapText(flag.help + " " + symbol, 6);
  if (!is_list) return text;
  const bool says_how_many = allowed.starts_with("one or more of ");
  return text + WrapText((says_how_many ? "" : "one of: ") + allowed, 6);
}

// `text`, and `more` behind it if it says something.
std::string With(const std::string& text,
                 const std::string& before,
                 const std::string& more,
                 const std::string& after = "") {
  return more.empty() ? text : text + before + more + after;
}

// Whether the name says the unit already: "sigma_px", "max_angle_deg".
bool EndsWithUnit(const Flag& flag) {
  return !flag.unit.empty() && flag.name.ends_with("_" + flag.unit);
}

// "- `--EdgeDetection.sigma_px` (1): sigma of the Gaussian derivatives".
std::string MarkdownItem(const Flag& flag, const std::string& paper_value) {
  const std::string unit = EndsWithUnit(flag) ? "" : flag.unit;
  std::string value = With(flag.default_value, " ", unit);
  if (paper_value != flag.default_value) {
    value = With(value, value.empty() ? "" : "; ", "paper " + paper_value);
  }
  return "- `--" + flag.name + "`" + With("", " (", value, ")") + ": " +
         flag.help + "\n";
}

std::string MarkdownList(const FlagSection& section, const FlagSection& paper) {
  std::string text = "\n## " + section.title + "\n\n";
  for (std::size_t i = 0; i < section.flags.size(); ++i) {
    text += MarkdownItem(section.flags[i], paper.flags[i].default_value);
  }
  return text;
}

constexpr char kMarkdownHead[] =
    "# Options\n"
    "\n"
    "<!-- Written by `colmap_curvix help --markdown`; a test compares. -->\n"
    "\n"
    "In brackets: the default and, if another, that of `--preset paper`.\n"
    "[Poses](#poses), [CurveFilter](#curvefilter) and [Runtime](#runtime)\n"
    "matter most; `--help_all` prints ranges and the paper's symbols. In a\n"
    "file (`--project_path x.ini`): `max_angle_deg=10` below\n"
    "`[Validation]`. Pixels are those of the original images; 1 is on, 0 is\n"
    "off. [Glossary](glossary.md).\n";

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
  PoseRefinementSettings poses;
  const FlagSection pose_flags = PoseRefinementFlags(&poses);
  std::string text = kMarkdownHead + MarkdownList(pose_flags, pose_flags);
  Options options;
  Options paper = PaperOptions();
  const std::vector<FlagSection> sections = OptionSections(options);
  const std::vector<FlagSection> papers = OptionSections(paper);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    text += MarkdownList(sections[i], papers[i]);
  }
  return text;
}

}  // namespace curvix
