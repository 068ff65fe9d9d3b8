// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/suggestion.h"

#include "gtest/gtest.h"

namespace curvix {
namespace {

TEST(Suggestion, PrefersTheNearestAndIsSilentWhenNoneIsNear) {
  const auto suggestion = [](const std::string& name,
                             const std::vector<std::string>& names) {
    return Suggestion(name, names, "--", "none");
  };
  const std::vector<std::string> names = {"A.min_length_px", "A.max_length_px"};
  const std::string min = "; did you mean '--A.min_length_px'?";
  EXPECT_EQ(suggestion("max_lenght_px", names),
            "; did you mean '--A.max_length_px'?");
  EXPECT_EQ(suggestion("B.min_length_px", names), min);
  EXPECT_EQ(suggestion("min_length", names), min);
  EXPECT_EQ(suggestion("zzz", names), "; none");
  EXPECT_EQ(suggestion("", names), "; none");
  EXPECT_EQ(suggestion("x", {}), "; none");
}

}  // namespace
}  // namespace curvix
