// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Project files: ours, and COLMAP's.
#pragma once

#include <curvix/status.h>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace curvix {

struct ProjectEntry {
  std::string name;  // "Section.name", or "name" before the first section
  std::string value;
  std::size_t line;  // from 1
};

// The lines `name = value` and `[Section]` of `text`, in order. Lines that
// begin with '#' or ';' are comments; elsewhere these are part of the value, as
// paths may hold them. A byte order mark is left out. Space around names and
// values does not count. kInvalidArgument, with the number of the line, for any
// other line.
Result<std::vector<ProjectEntry>> ParseProjectFile(std::string_view text);

}  // namespace curvix
