// SPDX-License-Identifier: BSD-3-Clause
// Text for people.
#pragma once

#include <cstddef>
#include <string>

namespace curvix {

inline constexpr std::size_t kColumns = 80;

// A space at which WrapText() does not break.
inline constexpr char kNoBreak = '\x01';

// `text` broken between words into lines of at most kColumns, each after
// `indent` spaces and with a line end.
std::string WrapText(const std::string& text, std::size_t indent);

// `text` as one word of a shell: in quotes, unless it needs none.
std::string ShellWord(const std::string& text);

// `text` with U+FFFD for what is not UTF-8, as names of files may be.
std::string ValidUtf8(const std::string& text);

// `text` without the control characters that names in files may have, and that
// a terminal would obey.
std::string ForTerminal(std::string text);

// A standard deviation: two digits, or all before the point.
std::string SigmaText(double sigma);

// "0.4 s", "3.1 s", "2 min 05 s", "1 h 02 min".
std::string DurationText(double seconds);

}  // namespace curvix
