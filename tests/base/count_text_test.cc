// SPDX-License-Identifier: BSD-3-Clause
#include "base/count_text.h"

#include "gtest/gtest.h"

namespace curvix {
namespace {

TEST(GroupDigits, PutsASpaceEveryThreeDigits) {
  EXPECT_EQ(GroupDigits(0), "0");
  EXPECT_EQ(GroupDigits(999), "999");
  EXPECT_EQ(GroupDigits(1000), "1 000");
  EXPECT_EQ(GroupDigits(171204), "171 204");
  EXPECT_EQ(GroupDigits(-1234567), "-1 234 567");
  EXPECT_EQ(GroupDigits(-123), "-123");
}

TEST(Plural, HasAnSUnlessItIsOne) {
  EXPECT_EQ(Plural(0, "view"), "0 views");
  EXPECT_EQ(Plural(1, "view"), "1 view");
  EXPECT_EQ(Plural(1200, "view"), "1 200 views");
}

TEST(CountText, NamesOneAsOne) {
  EXPECT_EQ(CountText(2, "view pairs"), "2 view pairs");
  EXPECT_EQ(CountText(1, "view pairs"), "1 view pair");
  EXPECT_EQ(CountText(1, "edges asked"), "1 edge asked");
  EXPECT_EQ(CountText(1, "hypotheses without support"),
            "1 hypothesis without support");
  EXPECT_EQ(CountText(1, "ellipses"), "1 ellipse");
  EXPECT_EQ(CountText(1, "left out by masks"), "1 left out by masks");
  EXPECT_EQ(CountText(1, "crease"), "1 crease");
}

}  // namespace
}  // namespace curvix
