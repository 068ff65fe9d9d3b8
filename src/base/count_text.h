// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Numbers of things, for people.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace curvix {

// "171204" as "171 204".
std::string GroupDigits(std::int64_t number);

// `one` if `count` is 1, else `more`: "is" or "are", say.
template <std::integral T>
std::string OneOrMore(T count, std::string_view one, std::string_view more) {
  return std::string(count == 1 ? one : more);
}

// "1 view", "1 200 views".
template <std::integral T>
std::string Plural(T count, const std::string& noun) {
  return GroupDigits(static_cast<std::int64_t>(count)) + " " + noun +
         OneOrMore(count, "", "s");
}

// "12 view pairs", "1 view pair": a count and the name of many. Names that
// begin with "left out" stay as they are.
std::string CountText(std::int64_t count, const std::string& name);

}  // namespace curvix
