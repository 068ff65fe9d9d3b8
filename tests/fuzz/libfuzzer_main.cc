// SPDX-License-Identifier: BSD-3-Clause
// The entry points that libFuzzer calls.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/fuzz_target.h"

// Writes the seeds into the folder that CURVIX_FUZZ_SEEDS names.
extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  const char* const folder = std::getenv("CURVIX_FUZZ_SEEDS");
  if (folder == nullptr) return 0;
  int number = 0;
  for (const std::string& seed : curvix::FuzzSeeds()) {
    const std::string name = "seed_" + std::to_string(number++);
    std::ofstream(std::filesystem::path(folder) / name, std::ios::binary)
        << seed;
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  curvix::FuzzReader({reinterpret_cast<const char*>(data), size});
  return 0;
}
