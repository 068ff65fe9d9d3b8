// SPDX-License-Identifier: BSD-3-Clause
#include "base/free_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>  // __GLIBC__
#include <fstream>
#include <memory>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace curvix {
namespace {

constexpr std::size_t kBlockBytes = 50'000;
constexpr std::size_t kNumBlocks = 2000;

// Linux only; 0: not known.
double ResidentBytes() {
  std::ifstream file("/proc/self/statm");
  double all_pages = 0, resident_pages = 0;
  if (!(file >> all_pages >> resident_pages)) return 0;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

TEST(ReleaseFreeMemory, GivesBackWhatIsFreedBelowWhatIsNot) {
#ifndef __GLIBC__
  GTEST_SKIP() << "glibc only";
#endif
  if (ResidentBytes() == 0) GTEST_SKIP() << "no /proc";
  std::vector<std::unique_ptr<std::vector<char>>> blocks;
  for (std::size_t i = 0; i < kNumBlocks; ++i) {
    blocks.push_back(std::make_unique<std::vector<char>>(kBlockBytes, 'x'));
  }
  const double all = 1.0 * kBlockBytes * kNumBlocks;
#ifdef __GLIBC__
  if (static_cast<double>(mallinfo2().uordblks) < all) {
    GTEST_SKIP() << "not glibc's malloc, but that of a sanitizer";
  }
#endif
  const auto last = std::move(blocks.back());
  blocks.clear();
  const double before = ResidentBytes();
  ReleaseFreeMemory();
  EXPECT_LT(ResidentBytes(), before - all / 2);
  EXPECT_EQ(last->size(), kBlockBytes);
}

}  // namespace
}  // namespace curvix
