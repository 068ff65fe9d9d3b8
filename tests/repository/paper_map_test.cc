// SPDX-License-Identifier: BSD-3-Clause
// Every file says what it is of the paper, itself or in its header, and
// docs/paper_map.md agrees, and names only files that exist.
#include <algorithm>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "tests/repository/source_tree.h"

namespace curvix {
namespace {

constexpr char kMap[] = "docs/paper_map.md";

// What line 2 of `file` says after "// Paper: "; empty if it says nothing.
std::string PaperLine(const std::string& file) {
  static const std::string start = "// Paper: ";
  const auto lines = Lines(ReadSource(file));
  if (lines.size() < 2 || lines[1].rfind(start, 0) != 0) return "";
  return lines[1].substr(start.size());
}

bool NamesASection(const std::string& paper) {
  static const std::regex section(R"(^Secs?\. [3-7]\b.*)");
  return std::regex_match(paper, section);
}

// Helpers without a counterpart; "beyond it" is for departures from the method.
bool IsOutsideThePaper(const std::string& paper) {
  return paper.rfind("none (engineering)", 0) == 0;
}
bool IsBeyondThePaper(const std::string& paper) {
  return paper.rfind("none (beyond it)", 0) == 0;
}

// "forces.{h,cc}" -> "forces.h", "forces.cc"; other names as they are.
std::vector<std::string> Expand(const std::string& name) {
  static const std::string braces = "{h,cc}";
  const auto at = name.find(braces);
  if (at == std::string::npos) return {name};
  return {name.substr(0, at) + "h", name.substr(0, at) + "cc"};
}

// The files that a text names: words with a folder and an ending of ours.
std::set<std::string> NamedFiles(const std::string& text) {
  static const std::regex pattern(
      R"([\w-]+(?:/[\w-]+)+\.(?:\{h,cc\}|(?:h|cc|md|cmake|sh|py)\b))");
  std::set<std::string> names;
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end;
       ++i) {
    for (const std::string& name : Expand(i->str())) names.insert(name);
  }
  return names;
}

// The path from the root of a file named as the map or an #include names it.
// Empty if there is none.
std::string Locate(const std::string& name) {
  for (const char* folder : {"", "src/", "include/", "docs/"}) {
    if (ExistsInTree(folder + name)) return folder + name;
  }
  return "";
}

TEST(PaperMap, EverySourceFileSaysWhatItIsOfThePaper) {
  const auto files = FilesBelow({"src"}, {".h", ".cc"});
  ASSERT_GT(files.size(), 100u);
  for (const std::string& file : files) {
    std::string paper = PaperLine(file);
    const std::string header = file.substr(0, file.rfind('.')) + ".h";
    if (paper.empty() && ExistsInTree(header)) paper = PaperLine(header);
    EXPECT_TRUE(NamesASection(paper) || IsOutsideThePaper(paper) ||
                IsBeyondThePaper(paper))
        << file << ", line 2, is '// Paper: " << paper
        << "'; it must begin with '// Paper: Sec. N' or '// Paper: none "
           "(engineering)' or '// Paper: none (beyond it)'";
  }
}

TEST(Pages, NameOnlyFilesThatExist) {
  auto pages = FilesBelow({"docs"}, {".md"});
  pages.push_back("README.md");
  std::size_t num_names = 0;
  for (const std::string& page : pages) {
    const auto names = NamedFiles(ReadSource(page));
    num_names += names.size();
    for (const std::string& name : names) {
      EXPECT_NE(Locate(name), "")
          << page << " names " << name << ", which is gone";
    }
  }
  EXPECT_GT(num_names, 100u);
}

// A newcomer finds the way in at most six files.
TEST(Pages, WalksThroughTheCodeAreShort) {
  const std::string page = ReadSource("docs/architecture.md");
  const std::size_t walks = page.find("## Two walks through the code");
  ASSERT_NE(walks, page.npos);
  const auto lines = Lines(page.substr(walks, page.find("## Folders") - walks));
  const auto steps = [&](const std::string& number) {
    return std::count_if(lines.begin(), lines.end(), [&](const auto& line) {
      return line.rfind(number + ". `", 0) == 0;
    });
  };
  EXPECT_EQ(steps("1"), 2);
  EXPECT_EQ(steps("7"), 0);
}

// "src/paper/align_edges.h" -> "src/paper".
std::string ParentOf(const std::string& file) {
  return file.substr(0, file.rfind('/'));
}

TEST(PaperMap, KnowsEveryFolderOfTheMethod) {
  std::set<std::string> known = {"src/model"};  // what passes between stages
  for (const std::string& name : NamedFiles(ReadSource(kMap))) {
    known.insert(ParentOf(Locate(name)));
  }
  for (const std::string& file : FilesBelow({"src"}, {".h"})) {
    if (IsOutsideThePaper(PaperLine(file))) continue;
    EXPECT_TRUE(known.contains(ParentOf(file)))
        << kMap << " names no file of " << ParentOf(file);
  }
}

// The section that the map gives for a file is one that the file names.
TEST(PaperMap, AgreesWithLineTwoOfTheFiles) {
  static const std::regex item(R"(- \*\*([3-7])\b[^:]*\*\*[^:]*: (.*))");
  int num_files = 0;
  for (const std::string& line : Lines(ReadSource(kMap))) {
    std::smatch match;
    if (!std::regex_match(line, match, item)) continue;
    for (const std::string& name : NamedFiles(match[2])) {
      ++num_files;
      const std::string paper = PaperLine(Locate(name));
      EXPECT_TRUE(NamesASection(paper) && paper.find(match[1]) != paper.npos)
          << kMap << ": " << line << ", but " << name << ": " << paper;
    }
  }
  EXPECT_GE(num_files, 15);
}

TEST(PaperMap, FindsNamesInText) {
  const std::set<std::string> expected = {"src/paper/align_edges.h",
                                          "src/paper/align_edges.cc",
                                          "tests/base/parallel_test.cc",
                                          "curvix/options.h"};
  EXPECT_EQ(NamedFiles("| `src/paper/align_edges.{h,cc}` | [t](tests/base/"
                       "parallel_test.cc), and/or <curvix/options.h>."),
            expected);
}

}  // namespace
}  // namespace curvix
