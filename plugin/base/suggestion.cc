// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/suggestion.h"

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <cstddef>
#include <utility>

namespace curvix {
namespace {

// Levenshtein's distance.
std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1] ? 1 : 0);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

// "Section.name" in lower case; "section." and "name" of it.
struct SplitName {
  std::string whole, section, field;

  explicit SplitName(const std::string& name)
      : whole(boost::algorithm::to_lower_copy(name)) {
    const std::size_t begin = whole.find('.') + 1;
    section = whole.substr(0, begin);
    field = whole.substr(begin);
  }
};

}  // namespace

std::string NearestName(const std::string& name,
                        const std::vector<std::string>& candidates) {
  std::string nearest;
  const SplitName wanted(name);
  // At most a third of the letters may differ.
  std::pair<std::size_t, std::size_t> least(
      std::max<std::size_t>(2, name.size() / 3) + 1, 0);
  for (const std::string& candidate : candidates) {
    const SplitName known(candidate);
    std::size_t distance = std::min(EditDistance(wanted.whole, known.whole),
                                    EditDistance(wanted.field, known.field));
    if (wanted.field.size() > 2 && known.field.starts_with(wanted.field)) {
      distance = std::min<std::size_t>(distance, 1);
    }
    const std::pair rating(distance,
                           EditDistance(wanted.section, known.section));
    if (rating < least) {
      least = rating;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string Suggestion(const std::string& name,
                       const std::vector<std::string>& candidates,
                       const std::string& prefix,
                       const std::string& otherwise) {
  const std::string nearest = NearestName(name, candidates);
  return nearest.empty() ? "; " + otherwise
                         : "; did you mean '" + prefix + nearest + "'?";
}

}  // namespace curvix
