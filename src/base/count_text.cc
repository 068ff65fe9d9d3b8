// SPDX-License-Identifier: BSD-3-Clause
#include "base/count_text.h"

#include <cstddef>

namespace curvix {
namespace {

// `name` with its first word in s as one of them.
std::string Singular(std::string name) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool is_end = i + 1 == name.size() || name[i + 1] == ' ';
    if (name[i] != 's' || !is_end) continue;
    const std::string_view word(name.data(), i + 1);
    return word.ends_with("hypotheses") ? name.replace(i - 1, 2, "is")
                                        : name.erase(i, 1);
  }
  return name;
}

}  // namespace

std::string GroupDigits(std::int64_t number) {
  std::string text = std::to_string(number);
  const int first = number < 0 ? 1 : 0;
  for (int i = static_cast<int>(text.size()) - 3; i > first; i -= 3) {
    text.insert(static_cast<std::size_t>(i), 1, ' ');
  }
  return text;
}

std::string CountText(std::int64_t count, const std::string& name) {
  const bool is_one = count == 1 && !name.starts_with("left out");
  return GroupDigits(count) + " " + (is_one ? Singular(name) : name);
}

}  // namespace curvix
