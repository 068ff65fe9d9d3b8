// SPDX-License-Identifier: BSD-3-Clause
// What --help prints, and docs/options.md.
#pragma once

#include <string>
#include <vector>

#include "plugin/command_line.h"

namespace curvix {

// The flags of one word: usage line, then one block a section with default,
// range, unit and meaning. At most 80 columns.
std::string HelpText(const std::string& usage,
                     const std::string& summary,
                     const std::vector<FlagSection>& sections);

// docs/options.md: every row of the option table with its default, its value
// with `--preset paper`, range, unit, place in the paper and meaning.
std::string OptionsMarkdown();

}  // namespace curvix
