// SPDX-License-Identifier: BSD-3-Clause
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace curvix {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnceForAnyNumberOfThreads) {
  for (const int num_threads : {1, 2, 3, 8}) {
    std::vector<int> visits(1000, 0);
    ParallelFor(
        visits.size(), num_threads, [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(visits, std::vector<int>(1000, 1)) << num_threads << " threads";
  }
}

TEST(ParallelFor, DoesNothingForNoItems) {
  ParallelFor(0, 4, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, RethrowsTheExceptionOfTheSmallestIndex) {
  for (const int num_threads : {1, 4}) {
    try {
      ParallelFor(100, num_threads, [](std::size_t i) {
        if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
  }
}

TEST(Concatenate, KeepsTheOrderOfParts) {
  EXPECT_EQ(Concatenate<int>({{1, 2}, {}, {3}}), (std::vector<int>{1, 2, 3}));
}

}  // namespace
}  // namespace curvix
