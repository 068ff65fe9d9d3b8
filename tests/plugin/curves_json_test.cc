// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/curves_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace curvix {
namespace {

TEST(JsonLines, PutsCommasBetweenAnyNumberOfValues) {
  for (const int num_threads : {1, 3}) {
    for (const int num_values : {0, 1, 255, 256, 257, 513}) {
      std::string text = "[";
      const ByteSink sink = [&](std::string_view bytes) { text += bytes; };
      JsonLines lines(num_threads, sink);
      for (int i = 0; i < num_values; ++i) {
        lines.Add([i] { return std::to_string(i); });
      }
      lines.Flush();
      const Json values = Json::parse(text + "]");
      ASSERT_EQ(values.size(), static_cast<std::size_t>(num_values));
      for (int i = 0; i < num_values; ++i) {
        EXPECT_EQ(values[static_cast<std::size_t>(i)], i);
      }
    }
  }
}

TEST(AppendJsonList, WritesWhatReadsBack) {
  const std::vector<std::vector<double>> rows = {
      {}, {0, -0.0, 1}, {0.1, 1e5, 1e300, -1e-9}, {std::nan(""), HUGE_VAL}};
  std::string text;
  AppendJsonList(
      rows,
      [](const std::vector<double>& row, std::string& out) {
        AppendJsonList(row, AppendJson<double>, out);
      },
      text);
  const Json read = Json::parse(text);
  ASSERT_EQ(read.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(read[i].size(), rows[i].size());
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      if (std::isfinite(rows[i][k])) {
        EXPECT_TRUE(read[i][k].is_number_float()) << text;
        EXPECT_EQ(read[i][k], rows[i][k]);
      } else {
        EXPECT_TRUE(read[i][k].is_null());
      }
    }
  }
}

TEST(AppendJson, WritesIntegersWithoutAPoint) {
  std::string text;
  AppendJson(17, text);
  EXPECT_EQ(text, "17");
}

TEST(RoundedToDigits, KeepsThemForAllMagnitudes) {
  for (const double unit : {1e-300, 1e-23, 1e-9, 1.0, 1e9, 1e300}) {
    const double value = -1.23456789012 * unit;
    const double rounded = RoundedToDigits(value, 5);
    EXPECT_NEAR(rounded / value, 1, 0.5e-4);
    EXPECT_LE(Json(rounded).dump().size(), std::string("-1234600000.0").size());
  }
}

TEST(RoundedToDigits, LeavesWhatHasNone) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(RoundedToDigits(0, 9), 0);
  EXPECT_EQ(RoundedToDigits(kInf, 9), kInf);
  EXPECT_EQ(RoundedToDigits(-kInf, 9), -kInf);
  EXPECT_TRUE(std::isnan(RoundedToDigits(std::nan(""), 9)));
  EXPECT_EQ(RoundedToDigits(kLeast, 9), kLeast);
}

}  // namespace
}  // namespace curvix
