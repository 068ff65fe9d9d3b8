// SPDX-License-Identifier: BSD-3-Clause
#include "base/text_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>

#include "base/bytes.h"

namespace curvix {
namespace {

using ::testing::ElementsAre;

TEST(SplitAt, GivesOnePartMoreThanThereAreSeparators) {
  EXPECT_THAT(SplitAt("ply,dxf", ','), ElementsAre("ply", "dxf"));
  EXPECT_THAT(SplitAt("", ','), ElementsAre(""));
  EXPECT_THAT(SplitAt(",a,,", ','), ElementsAre("", "a", "", ""));
}

TEST(NumberText, IsTheShortestThatReadsBackTheSame) {
  EXPECT_EQ(NumberText(0.1), "0.1");
  EXPECT_EQ(NumberText(-3), "-3");
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
