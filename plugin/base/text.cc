// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <string_view>

#include "base/text_fields.h"
#include "plugin/base/json.h"

namespace curvix {
std::string WrapText(const std::string& text, std::size_t indent) {
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
  wrapped += std::string(indent, ' ') + line + "\n";
  std::ranges::replace(wrapped, kNoBreak, ' ');
  return wrapped;
}

std::string ShellWord(const std::string& text) {
  const bool is_plain = !text.empty() && std::ranges::all_of(text, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("/._-+:@%,").find(c) != std::string_view::npos;
  });
  if (is_plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string ValidUtf8(const std::string& text) {
  const std::string valid =
      Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(valid).get<std::string>();
}

std::string ForTerminal(std::string text) {
  std::ranges::replace_if(
      text,
      [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; },
      '?');
  return text;
}

std::string SigmaText(double sigma) {
  return sigma < 99.5 ? ShortText(sigma, 2) : FixedText(sigma, 0);
}

std::string DurationText(double seconds) {
  if (seconds < 59.95) {
    return FixedText(std::max(seconds, 0.0), 1) + " s";
  }
  const int whole = static_cast<int>(std::min(std::round(seconds), 1e9));
  const auto two_digits = [](int number) {
    return (number < 10 ? "0" : "") + std::to_string(number);
  };
  if (whole < 3600) {
    return std::to_string(whole / 60) + " min " + two_digits(whole % 60) + " s";
  }
  return std::to_string(whole / 3600) + " h " + two_digits(whole / 60 % 60) +
         " min";
}

}  // namespace curvix
