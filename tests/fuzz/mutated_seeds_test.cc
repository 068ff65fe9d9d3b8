// SPDX-License-Identifier: BSD-3-Clause
// A short run of a fuzzer without libFuzzer: the same seeds, changed in the
// same ways each time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_target.h"

namespace curvix {
namespace {

class Mutator {
 public:
  // Changes `bytes` in one to four places.
  std::string Mutate(std::string bytes) {
    for (std::size_t i = Below(4) + 1; i > 0; --i) ChangeOnePlace(bytes);
    return bytes;
  }

 private:
  // Below `limit`, which is not zero.
  std::size_t Below(std::size_t limit) { return random_() % limit; }

  void ChangeOnePlace(std::string& bytes) {
    using std::string_literals::operator""s;
    // Counts that are too large, NaN, and what text formats stumble over.
    static const std::array kWords = {"\xff\xff\xff\xff\xff\xff\xff\xff"s,
                                      "\0\0\0\0\0\0\0\x80"s,
                                      "\0\0\0\0\0\0\0\0"s,
                                      "\0\0\0\0\0\0\xf8\x7f"s,
                                      "\0\0\0\x80"s,
                                      "nan"s,
                                      "1e999"s,
                                      "-1"s,
                                      "18446744073709551616"s,
                                      "\n"s,
                                      " "s};
    const std::size_t at = Below(bytes.size() + 1);
    const std::size_t length = Below(std::min<std::size_t>(
        bytes.size() - at + 1, std::size_t{1} << Below(8)));
    switch (Below(6)) {
      case 0:
        if (at < bytes.size()) bytes[at] = static_cast<char>(Below(256));
        break;
      case 1:
        if (at < bytes.size()) {
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << Below(8)));
        }
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 4:
        bytes.insert(at, bytes.substr(at, length));
        break;
      default: {
        const std::string& word = kWords[Below(kWords.size())];
        bytes.replace(at, std::min(word.size(), bytes.size() - at), word);
      }
    }
  }

  std::mt19937_64 random_{20240607};
};

TEST(MutatedSeeds, AreReadOrRefused) {
  constexpr int kRounds = 1500;
  const std::vector<std::string> seeds = FuzzSeeds();
  ASSERT_FALSE(seeds.empty());
  for (const std::string& seed : seeds) ASSERT_NO_THROW(FuzzReader(seed));
  Mutator mutator;
  for (int i = 0; i < kRounds; ++i) {
    const std::string bytes =
        mutator.Mutate(seeds[static_cast<std::size_t>(i) % seeds.size()]);
    ASSERT_NO_THROW(FuzzReader(bytes)) << "round " << i;
  }
}

}  // namespace
}  // namespace curvix
