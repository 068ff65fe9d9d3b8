// SPDX-License-Identifier: BSD-3-Clause
// The links of all pages lead to files that exist, and to headings in them.
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/repository/source_tree.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

// Without fenced code, in which brackets and # are no links and no headings.
std::vector<std::string> LinesOfProse(const std::string& text) {
  std::vector<std::string> lines;
  bool in_code = false;
  for (const std::string& line : Lines(text)) {
    const bool is_fence =
        line.find("```") == line.find_first_not_of(' ') && !line.empty();
    if (is_fence) in_code = !in_code;
    if (!is_fence && !in_code) lines.push_back(line);
  }
  return lines;
}

// The targets of [text](target) that are neither URLs nor mail addresses.
std::vector<std::string> LocalLinks(const std::string& text) {
  static const std::regex link(R"(\]\(([^)\s]+)\))");
  std::vector<std::string> targets;
  for (const std::string& line : LinesOfProse(text)) {
    for (std::sregex_iterator i(line.begin(), line.end(), link), end; i != end;
         ++i) {
      const std::string target = (*i)[1];
      if (target.find(':') == std::string::npos) targets.push_back(target);
    }
  }
  return targets;
}

// GitHub's name of a heading: lower case, '-' for blanks, no other signs.
std::string Anchor(const std::string& heading) {
  std::string anchor;
  for (const char sign : heading) {
    const auto c = static_cast<unsigned char>(sign);
    const bool is_kept = std::isalnum(c) || c == '-' || c == '_' || c >= 0x80;
    if (is_kept) anchor += static_cast<char>(std::tolower(c));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

std::set<std::string> Anchors(const std::string& text) {
  static const std::regex heading(R"(#+ +(.*[^ ]) *)");
  std::set<std::string> anchors;
  std::smatch match;
  for (const std::string& line : LinesOfProse(text)) {
    if (std::regex_match(line, match, heading)) {
      anchors.insert(Anchor(match[1]));
    }
  }
  return anchors;
}

std::vector<std::string> AllPages() {
  auto pages = FilesBelow(
      {"docs", "examples", "include", "plugin", "src", "tests"}, {".md"});
  for (const auto& entry : fs::directory_iterator(CURVIX_SOURCE_DIR)) {
    if (entry.path().extension() == ".md") {
      pages.push_back(entry.path().filename().string());
    }
  }
  return pages;
}

TEST(Links, LeadToFilesAndHeadingsThatExist) {
  const auto pages = AllPages();
  ASSERT_GT(pages.size(), 20u);
  int num_links = 0;
  for (const std::string& page : pages) {
    for (const std::string& link : LocalLinks(ReadSource(page))) {
      ++num_links;
      const auto hash = link.find('#');
      const fs::path folder = fs::path(page).parent_path();
      const std::string file =
          hash == 0
              ? page
              : (folder / link.substr(0, hash)).lexically_normal().string();
      EXPECT_TRUE(ExistsInTree(file))
          << page << " links to " << link << ", which is not there";
      if (hash == std::string::npos) continue;
      EXPECT_TRUE(Anchors(ReadSource(file)).contains(link.substr(hash + 1)))
          << page << " links to " << link << ", but " << file
          << " has no such heading";
    }
  }
  EXPECT_GT(num_links, 50);
}

TEST(Links, AreFoundInText) {
  EXPECT_THAT(LocalLinks("[a](b.md#c), ![d](e/f.png) [g](https://h.org)\n"
                         "```\n[i](j.md)\n```\n[k](#l)"),
              ElementsAre("b.md#c", "e/f.png", "#l"));
  EXPECT_THAT(Anchors("# Table E: lines, `x_y` and 2 °\n```\n# no\n```\n"),
              ElementsAre("table-e-lines-x_y-and-2-°"));
}

}  // namespace
}  // namespace curvix
