// SPDX-License-Identifier: BSD-3-Clause
// What a fuzzer of one reader consists of. Each is linked with
// libfuzzer_main.cc and run for hours, and with mutated_seeds_test.cc for the
// ordinary tests.
#pragma once

#include <curvix/status.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace curvix {

// Inputs that the reader accepts, made by our own writers.
std::vector<std::string> FuzzSeeds();

// Gives `bytes` to the reader, and its result to what uses it next. Throws
// nothing, whatever the bytes are, unless the reader breaks its promise.
void FuzzReader(std::string_view bytes);

// Throws unless `condition` holds.
inline void Require(bool condition, const char* promise) {
  if (!condition) throw std::logic_error(promise);
}

inline void RequireSentence(const Status& status) {
  Require(status.ok() || !status.message().empty(), "errors say what is wrong");
}

// Takes one character off `bytes`, which chooses among `count` readers.
inline std::size_t TakeChoice(std::string_view& bytes, std::size_t count) {
  if (bytes.empty()) return 0;
  const auto first = static_cast<unsigned char>(bytes.front());
  bytes.remove_prefix(1);
  return first % count;
}

}  // namespace curvix
