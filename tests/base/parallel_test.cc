// SPDX-License-Identifier: BSD-3-Clause
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
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

// How many of the first indices were visited, if no later one was.
std::size_t NumVisited(const std::vector<int>& visits) {
  const auto end = std::find(visits.begin(), visits.end(), 0);
  EXPECT_EQ(std::count(end, visits.end(), 1), 0) << "a gap";
  return static_cast<std::size_t>(end - visits.begin());
}

TEST(ParallelForWhile, EndsOnceTheCallingThreadIsToldTo) {
  for (const int num_threads : {1, 4}) {
    std::vector<int> visits(100000, 0);
    std::size_t last = 0;
    ParallelForWhile(
        visits.size(),
        num_threads,
        [&](std::size_t i) {
          visits[i] = 1;
          return true;
        },
        [&](std::size_t num_ended) {
          EXPECT_GT(num_ended, last);
          last = num_ended;
          return num_ended < 10;
        });
    EXPECT_GE(NumVisited(visits), last);
    if (num_threads == 1) {  // of four, it may come too late to do any
      EXPECT_EQ(NumVisited(visits), 10U);
    }
  }
}

TEST(ParallelForWhile, EndsOnceACallSaysSo) {
  for (const int num_threads : {1, 4}) {
    std::vector<int> visits(100000, 0);
    ParallelForWhile(
        visits.size(),
        num_threads,
        [&](std::size_t i) {
          visits[i] = 1;
          return i != 20;
        },
        [](std::size_t) { return true; });
    EXPECT_GT(NumVisited(visits), 20U);
    if (num_threads == 1) {
      EXPECT_EQ(NumVisited(visits), 21U);
    }
  }
}

TEST(ParallelForWhile, EndsOnceAskingThrows) {
  std::vector<int> visits(100000, 0);
  EXPECT_THROW(ParallelForWhile(
                   visits.size(),
                   1,
                   [&](std::size_t i) {
                     visits[i] = 1;
                     return true;
                   },
                   [](std::size_t done) -> bool {
                     if (done == 10) throw std::runtime_error("enough");
                     return true;
                   }),
               std::runtime_error);
  EXPECT_EQ(NumVisited(visits), 10U);
}

TEST(Concatenate, KeepsTheOrderOfParts) {
  EXPECT_EQ(Concatenate<int>({{1, 2}, {}, {3}}), (std::vector<int>{1, 2, 3}));
}

}  // namespace
}  // namespace curvix
