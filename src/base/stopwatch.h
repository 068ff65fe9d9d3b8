// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What a stage of a run cost.
#pragma once

#include <curvix/reconstruct.h>
#include <chrono>
#include <string>

namespace curvix {

using StageCounts = decltype(StageReport::counts);

// Measures from its construction.
class Stopwatch {
 public:
  Stopwatch();

  // Wall seconds and CPU seconds of all threads since the construction, and
  // the largest resident memory of the process so far.
  StageReport Read(std::string name, StageCounts counts = {}) const;

 private:
  std::chrono::steady_clock::time_point wall_start_;
  double cpu_start_ = 0;  // seconds
};

}  // namespace curvix
