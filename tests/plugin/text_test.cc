// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/text.h"

#include <sstream>

#include "gtest/gtest.h"

namespace curvix {
namespace {

TEST(WrapText, KeepsWordsAndColumns) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "word" + std::to_string(i) + " ";
  std::istringstream lines(WrapText(text, 6));
  std::string words;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), kColumns);
    EXPECT_EQ(line.substr(0, 10), "      word");
    words += line.substr(6) + " ";
  }
  EXPECT_EQ(words, text);
}

TEST(WrapText, DoesNotBreakAtSpacesThatForbidIt) {
  const std::string text = std::string(70, 'x') + " Delta" + kNoBreak + "gamma";
  EXPECT_EQ(WrapText(text, 0), std::string(70, 'x') + "\nDelta gamma\n");
}

TEST(WrapText, LetsLongWordsStick) {
  EXPECT_EQ(WrapText(std::string(100, 'x'), 2),
            "  " + std::string(100, 'x') + "\n");
  EXPECT_EQ(WrapText("", 0), "\n");
}

TEST(ShellWord, IsQuotedIfItMust) {
  EXPECT_EQ(ShellWord("/tmp/a-b_1.x"), "/tmp/a-b_1.x");
  EXPECT_EQ(ShellWord("sy 3/\xc3\xa4"), "'sy 3/\xc3\xa4'");
  EXPECT_EQ(ShellWord("it's"), "'it'\\''s'");
  EXPECT_EQ(ShellWord(""), "''");
}

TEST(ValidUtf8, ReplacesWhatIsNot) {
  EXPECT_EQ(ValidUtf8("sy \xc3\xa4 \"<\n"), "sy \xc3\xa4 \"<\n");
  EXPECT_EQ(ValidUtf8("caf\xe9"), "caf\xef\xbf\xbd");
}

TEST(DurationText, ChoosesTheUnitsThatMatter) {
  EXPECT_EQ(DurationText(0), "0.0 s");
  EXPECT_EQ(DurationText(-1), "0.0 s");
  EXPECT_EQ(DurationText(3.14), "3.1 s");
  EXPECT_EQ(DurationText(59.96), "1 min 00 s");
  EXPECT_EQ(DurationText(125), "2 min 05 s");
  EXPECT_EQ(DurationText(3599.6), "1 h 00 min");
  EXPECT_EQ(DurationText(3720), "1 h 02 min");
}

TEST(ForTerminal, TakesControlCharactersOut) {
  EXPECT_EQ(ForTerminal("a\x1b[2Jb\n\xc3\xa4"), "a?[2Jb?\xc3\xa4");
}

}  // namespace
}  // namespace curvix
