// SPDX-License-Identifier: BSD-3-Clause
#include "colmap/project_file.h"

#include "base/line_reader.h"

namespace curvix {

Result<std::vector<ProjectEntry>> ParseProjectFile(std::string_view text) {
  std::vector<ProjectEntry> entries;
  std::string section;
  LineReader lines(text);
  while (const auto next = lines.NextFilled()) {
    const std::string_view line = *next;
    if (line.front() == ';') continue;
    if (line.front() == '[' && line.back() == ']') {
      section = Trimmed(line.substr(1, line.size() - 2));
      if (!section.empty()) section += '.';
      continue;
    }
    const std::size_t equals = line.find('=');
    const std::string name(Trimmed(line.substr(0, equals)));
    if (equals == std::string_view::npos || name.empty()) {
      return Status::InvalidArgument("line " +
                                     std::to_string(lines.line_number()) +
                                     " is neither name=value nor [Section]");
    }
    entries.push_back({section + name,
                       std::string(Trimmed(line.substr(equals + 1))),
                       lines.line_number()});
  }
  return entries;
}

}  // namespace curvix
