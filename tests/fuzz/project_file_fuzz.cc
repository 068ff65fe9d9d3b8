// SPDX-License-Identifier: BSD-3-Clause
// The project file with the options of a run.

#include "plugin/base/command_line.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/temporary_folder.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  Options options;
  std::string text = "# comment\nworkspace_path = /a b/#c\r\ncolor=red\n";
  for (const OptionRow& row : OptionTable(options)) {
    text += FullName(row) + "=" + ValueText(row) + "\n";
  }
  return {text, "[Validation]\nmax_angle_deg=9\n[ EdgeDetection ]\nsigma_px=2"};
}

void FuzzReader(std::string_view bytes) {
  static const TemporaryFolder folder;
  const auto path = folder.Write("project.ini", std::string(bytes));
  std::filesystem::path workspace_path;
  std::filesystem::path project_path;
  std::string color = "red";
  Options options;
  std::vector<FlagSection> sections = OptionSections(options);
  sections.push_back({"Paths",
                      {PathFlag("workspace_path", &workspace_path, ""),
                       PathFlag("project_path", &project_path, ""),
                       ChoiceFlag("color", {"red", "blue"}, &color, "")}});
  RequireSentence(
      ParseFlags({"--project_path", path.string()}, sections).status());
  RequireSentence(Validate(options));
}

}  // namespace curvix
