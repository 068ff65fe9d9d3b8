// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Texts line by line and word by word.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

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

// Reads words from the front of a text. The first that is missing or malformed
// fails; from then on numbers are zero.
class WordReader {
 public:
  explicit WordReader(std::string_view text) : rest_(text) {}

  bool failed() const { return failed_; }
  // Whether no word is left, or one has failed.
  bool AtEnd() const {
    return failed_ || rest_.find_first_not_of(kSpace) == rest_.npos;
  }
  std::size_t bytes_left() const { return rest_.size(); }

  std::string_view Word() {
    const std::string_view word = TakeWord(rest_);
    failed_ = failed_ || word.empty();
    return word;
  }
  template <typename T>
  T Number() {
    const std::optional<T> value = ParseNumber<T>(Word());
    failed_ = failed_ || !value;
    return failed_ ? T{} : *value;
  }
  // Takes the next word if it is `word`; whether it was.
  bool Skip(std::string_view word) {
    std::string_view rest = rest_;
    if (TakeWord(rest) != word) return false;
    rest_ = rest;
    return true;
  }
  // What is left of a line, without the blanks around it.
  std::string_view Rest() {
    const std::string_view rest = Trimmed(std::exchange(rest_, {}));
    failed_ = failed_ || rest.empty();
    return rest;
  }

 private:
  std::string_view rest_;
  bool failed_ = false;
};

}  // namespace curvix
