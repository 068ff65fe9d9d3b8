// SPDX-License-Identifier: BSD-3-Clause
// Rules that every file keeps.
#include <filesystem>
#include <map>
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

constexpr char kLicense[] = "SPDX-License-Identifier: BSD-3-Clause";
const std::vector<std::string> kFolders = {
    "src", "plugin", "include", "tests", "examples"};

TEST(SourceRules, CodeBeginsWithItsLicense) {
  const auto files = FilesBelow(kFolders, {".h", ".cc"});
  ASSERT_GT(files.size(), 100u);
  for (const std::string& file : files) {
    const auto lines = Lines(ReadSource(file));
    ASSERT_FALSE(lines.empty()) << file;
    EXPECT_EQ(lines[0], std::string("// ") + kLicense) << file;
  }
}

TEST(SourceRules, ScriptsNameTheirLicense) {
  auto files = FilesBelow(kFolders, {".sh", ".cmake", ".py", ".txt", ".in"});
  files.push_back("CMakeLists.txt");
  for (const std::string& file : files) {
    const auto lines = Lines(ReadSource(file));
    ASSERT_FALSE(lines.empty()) << file;
    const bool has_interpreter = lines[0].rfind("#!", 0) == 0;
    ASSERT_GT(lines.size(), 1u) << file;
    EXPECT_EQ(lines[has_interpreter ? 1 : 0], std::string("# ") + kLicense)
        << file;
  }
}

TEST(SourceRules, FilesAreUnder400Lines) {
  for (const std::string& file : FilesBelow(kFolders, {".h", ".cc"})) {
    EXPECT_LT(Lines(ReadSource(file)).size(), 400u) << file << ": split it";
  }
}

TEST(SourceRules, LinesEndCleanly) {
  for (const std::string& file : FilesBelow(kFolders, {".h", ".cc"})) {
    const std::string text = ReadSource(file);
    EXPECT_EQ(text.back(), '\n') << file;
    EXPECT_EQ(text.find('\t'), std::string::npos) << file << ": a tab";
    EXPECT_EQ(text.find(" \n"), std::string::npos) << file << ": space at end";
  }
}

// A shell would obey what file names hold. execve() starts the named program or
// nothing.
TEST(SourceRules, NoShellStartsPrograms) {
  const std::regex shell(R"(\b(system|popen|exec(l|le|lp|v|vp|vpe))\s*\()");
  for (const std::string& file :
       FilesBelow({"src", "plugin", "include"}, {".h", ".cc"})) {
    EXPECT_FALSE(std::regex_search(ReadSource(file), shell)) << file;
  }
}

// Of two types with one name, the linker keeps the functions of one.
TEST(SourceRules, TypesOfHeadersHaveOneName) {
  const std::regex type(
      R"(\n(?:struct|class|enum class) (?:\[\[\w+\]\] )?(\w+)[^;{]*\{)");
  std::map<std::string, std::string> file_of;
  for (const std::string& file :
       FilesBelow({"src", "plugin", "include", "tests"}, {".h"})) {
    const std::string text = ReadSource(file);
    for (std::sregex_iterator it(text.begin(), text.end(), type), end;
         it != end;
         ++it) {
      const auto [other, is_new] = file_of.emplace((*it)[1], file);
      EXPECT_TRUE(is_new) << (*it)[1] << ": " << other->second << ", " << file;
    }
  }
  EXPECT_GT(file_of.size(), 100u);
}

TEST(SourceRules, TheRootHoldsSixFolders) {
  const std::set<std::string> expected = {
      "docs", "examples", "include", "plugin", "src", "tests"};
  std::set<std::string> actual;
  for (const auto& entry : fs::directory_iterator(CURVIX_SOURCE_DIR)) {
    const std::string name = entry.path().filename().string();
    // .gitignore names these.
    const bool is_ignored = name.rfind("build", 0) == 0 || name == "proj";
    if (entry.is_directory() && name[0] != '.' && !is_ignored) {
      actual.insert(name);
    }
  }
  EXPECT_EQ(actual, expected);
}

TEST(SourceRules, TheCommonHeaderIncludesEveryPublicOne) {
  const std::string common = ReadSource("include/curvix/curvix.h");
  const auto headers = FilesBelow({"include/curvix"}, {".h"});
  ASSERT_GT(headers.size(), 5u);
  for (const std::string& header : headers) {
    if (header == "include/curvix/curvix.h") continue;
    const std::string name = header.substr(sizeof("include/") - 1);
    EXPECT_THAT(common, testing::HasSubstr("#include <" + name + ">\n"));
  }
}

}  // namespace
}  // namespace curvix
