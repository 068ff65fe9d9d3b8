// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Lines, words and numbers of text files, the same
// in every locale.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace curvix {

// Appends the shortest text that reads back as exactly `value`.
template <typename T>
void AppendNumber(T value, std::string& out) {
  std::array<char, 32> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  out.append(text.data(), end);
}

// `value` as AppendNumber writes it.
template <typename T>
std::string NumberText(T value) {
  std::string text;
  AppendNumber(value, text);
  return text;
}

// Appends numbers as AppendNumber writes them, with `separator` between.
template <typename Numbers>
void AppendNumbers(const Numbers& numbers, char separator, std::string& out) {
  const std::size_t begin = out.size();
  for (const auto number : numbers) {
    if (out.size() > begin) out += separator;
    AppendNumber(number, out);
  }
}

// `value` as std::to_chars writes it, with a precision of at most 60.
inline std::string FormatText(double value,
                              std::chars_format format,
                              int precision) {
  std::array<char, 400> text;  // the largest number has 309 digits
  char* end = text.data() + text.size();
  return {text.data(),
          std::to_chars(text.data(), end, value, format, precision).ptr};
}

// `value` with so many decimals, at most 60.
inline std::string FixedText(double value, int num_decimals) {
  return FormatText(value, std::chars_format::fixed, num_decimals);
}

// `value` with at most so many digits that count, as std::printf writes it with
// "%.4g": "1230", "0.00123", "1.23e-05".
inline std::string ShortText(double value, int num_digits) {
  return FormatText(value, std::chars_format::general, num_digits);
}

// The number that `word` is as a whole; an optional sign leads. nullopt: it is
// none, or does not fit into T.
template <typename T>
std::optional<T> ParseNumber(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  T value{};
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

// White space within a line.
constexpr std::string_view kBlanks = " \t\r\v\f";

// `text` without the blanks around it.
inline std::string_view Trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

// Takes the next line off `text`, without its "\n" or "\r\n".
inline std::string_view TakeLine(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

// The parts of `text` between the separators: one more than there are of these.
inline std::vector<std::string_view> SplitAt(std::string_view text,
                                             char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// `count` numbers with commas between; empty: `text` is not that.
inline std::vector<double> ParseNumbers(std::string_view text,
                                        std::size_t count) {
  std::vector<double> numbers;
  for (const std::string_view part : SplitAt(text, ',')) {
    const std::optional<double> number = ParseNumber<double>(part);
    if (!number) return {};
    numbers.push_back(*number);
  }
  if (numbers.size() != count) return {};
  return numbers;
}

// White space, ends of lines included.
inline constexpr std::string_view kSpace = " \t\r\n\v\f";

// Takes the next word off `text`; empty at the end.
inline std::string_view TakeWord(std::string_view& text) {
  const std::size_t begin = text.find_first_not_of(kSpace);
  text.remove_prefix(begin == std::string_view::npos ? text.size() : begin);
  const std::string_view word = text.substr(0, text.find_first_of(kSpace));
  text.remove_prefix(word.size());
  return word;
}

}  // namespace curvix
