// SPDX-License-Identifier: BSD-3-Clause
// What --help prints, and docs/options.md.
#pragma once

#include <string>
#include <vector>

#include "plugin/base/command_line.h"

namespace curvix {

// The flags of a command: usage line, then one block a section with default,
// range, unit and meaning. At most 80 columns. Without advanced flags, unless
// `with_advanced`, it ends with how many there are.
std::string HelpText(const std::string& usage,
                     const std::string& summary,
                     const std::vector<FlagSection>& sections,
                     bool with_advanced);

// docs/options.md: every option with its default, its value with
// `--preset paper` and its meaning.
std::string OptionsMarkdown();

}  // namespace curvix
