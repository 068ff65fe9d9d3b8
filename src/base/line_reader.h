// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "base/text_fields.h"

namespace curvix {

// Some editors begin a text in UTF-8 with this mark.
inline std::string_view WithoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
  }
  return text;
}

// The lines of a text that are not comments, which begin with "#", without the
// blanks around them.
class LineReader {
 public:
  explicit LineReader(std::string_view text)
      : text_(WithoutByteOrderMark(text)) {}

  // Of the line given last, from 1; at the end, of the last line.
  std::size_t line_number() const { return line_number_; }
  std::size_t bytes_left() const { return text_.size(); }

  // The next line, which may be empty; nullopt at the end.
  std::optional<std::string_view> Next() {
    while (!text_.empty()) {
      const std::string_view line = Trimmed(TakeLine(text_));
      ++line_number_;
      if (!line.starts_with('#')) return line;
    }
    return std::nullopt;
  }

  // The next line that is not empty; nullopt at the end.
  std::optional<std::string_view> NextFilled() {
    std::optional<std::string_view> line = Next();
    while (line && line->empty()) line = Next();
    return line;
  }

 private:
  std::string_view text_;
  std::size_t line_number_ = 0;
};

}  // namespace curvix
