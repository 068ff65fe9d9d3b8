// SPDX-License-Identifier: BSD-3-Clause
#include "base/text_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <array>
#include <clocale>
#include <cstdio>
#include <optional>
#include <string>

#include "base/bytes.h"

namespace curvix {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(SplitAt, GivesOnePartMoreThanThereAreSeparators) {
  EXPECT_THAT(SplitAt("ply,dxf", ','), ElementsAre("ply", "dxf"));
  EXPECT_THAT(SplitAt("", ','), ElementsAre(""));
  EXPECT_THAT(SplitAt(",a,,", ','), ElementsAre("", "a", "", ""));
}

TEST(NumberText, IsTheShortestThatReadsBackTheSame) {
  EXPECT_EQ(NumberText(0.1), "0.1");
  EXPECT_EQ(NumberText(-3), "-3");
}

TEST(FixedText, HasSoManyDecimals) {
  EXPECT_EQ(FixedText(1.25, 3), "1.250");
  EXPECT_EQ(FixedText(-1234.5678, 1), "-1234.6");
  EXPECT_EQ(FixedText(99.5, 0), "100");
}

TEST(ShortText, IsWhatPrintfWrites) {
  for (const double value : {0.0,
                             -1.0,
                             0.1,
                             1234.5,
                             12345.0,
                             1.0 / 3,
                             1.23e-5,
                             2e-4,
                             5812350.25,
                             1e300,
                             -0.00098765}) {
    for (const int num_digits : {1, 2, 4, 6, 15}) {
      std::array<char, 64> text;
      std::snprintf(text.data(), text.size(), "%.*g", num_digits, value);
      EXPECT_EQ(ShortText(value, num_digits), text.data());
    }
  }
}

TEST(TextFields, NumbersAreTheSameInEveryLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  bool has_comma = false;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    has_comma = has_comma || std::setlocale(LC_NUMERIC, name) != nullptr;
  }
  const std::string fixed = FixedText(1.5, 1), brief = ShortText(0.25, 3);
  const std::optional<double> parsed = ParseNumber<double>("1.5");
  std::setlocale(LC_NUMERIC, before.c_str());
  if (!has_comma) GTEST_SKIP() << "no locale with a decimal comma";
  EXPECT_EQ(fixed, "1.5");
  EXPECT_EQ(brief, "0.25");
  EXPECT_EQ(parsed, 1.5);
}

TEST(ParseNumber, TakesOneSign) {
  EXPECT_EQ(ParseNumber<int>("5"), 5);
  EXPECT_EQ(ParseNumber<int>("+5"), 5);
  EXPECT_EQ(ParseNumber<int>("-5"), -5);
  EXPECT_EQ(ParseNumber<double>("+.5"), 0.5);
  for (const char* word : {"+-5", "++5", "-+5", "--5", "+", "-", "", "5 "}) {
    EXPECT_EQ(ParseNumber<int>(word), std::nullopt) << word;
    EXPECT_EQ(ParseNumber<double>(word), std::nullopt) << word;
  }
}

TEST(ParseNumbers, TakesSoManyWithCommasBetween) {
  EXPECT_THAT(ParseNumbers("1,-2.5,+1e3", 3), ElementsAre(1, -2.5, 1000));
  EXPECT_THAT(ParseNumbers("7", 1), ElementsAre(7));
  for (const char* text : {"", "1", "1,2,3", "1,2,", "1,", "1, 2", "1;2"}) {
    EXPECT_THAT(ParseNumbers(text, 2), IsEmpty()) << text;
  }
}

TEST(Bytes, NamesEndWithNul) {
  ByteWriter writer;
  writer.PutName("a.png");
  writer.PutName("");
  ByteReader reader(writer.bytes());
  EXPECT_EQ(reader.TakeName(), "a.png");
  EXPECT_EQ(reader.TakeName(), "");
  EXPECT_TRUE(reader.AtEnd());
  EXPECT_EQ(reader.TakeName(), "");
  EXPECT_FALSE(reader.ok());
}

}  // namespace
}  // namespace curvix
