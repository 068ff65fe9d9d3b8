// SPDX-License-Identifier: BSD-3-Clause
#include "base/line_reader.h"

#include <gtest/gtest.h>
#include <optional>

namespace curvix {
namespace {

TEST(LineReader, SkipsCommentsAndCountsThem) {
  LineReader lines("# head\n a b \r\n\n  # within\nc");
  EXPECT_EQ(lines.Next(), "a b");
  EXPECT_EQ(lines.line_number(), 2u);
  EXPECT_EQ(lines.Next(), "");
  EXPECT_EQ(lines.line_number(), 3u);
  EXPECT_EQ(lines.bytes_left(), 12u);
  EXPECT_EQ(lines.Next(), "c");
  EXPECT_EQ(lines.line_number(), 5u);
  EXPECT_EQ(lines.Next(), std::nullopt);
  EXPECT_EQ(lines.line_number(), 5u);
}

TEST(LineReader, NextFilledSkipsEmptyLinesToo) {
  LineReader lines("\n \t\n# head\na\n\n");
  EXPECT_EQ(lines.NextFilled(), "a");
  EXPECT_EQ(lines.line_number(), 4u);
  EXPECT_EQ(lines.NextFilled(), std::nullopt);
  EXPECT_EQ(lines.line_number(), 5u);
}

TEST(LineReader, LeavesOutAByteOrderMark) {
  LineReader lines("\xEF\xBB\xBF# head\na");
  EXPECT_EQ(lines.Next(), "a");
}

TEST(LineReader, NoLinesInAnEmptyText) {
  LineReader lines("");
  EXPECT_EQ(lines.Next(), std::nullopt);
  EXPECT_EQ(lines.line_number(), 0u);
}

}  // namespace
}  // namespace curvix
