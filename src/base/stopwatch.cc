// SPDX-License-Identifier: BSD-3-Clause
#include "base/stopwatch.h"

#include <sys/resource.h>
#include <ctime>
#include <utility>

namespace curvix {
namespace {

// Of all threads.
double CpuSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

Stopwatch::Stopwatch()
    : wall_start_(std::chrono::steady_clock::now()), cpu_start_(CpuSeconds()) {}

StageReport Stopwatch::Read(std::string name, StageCounts counts) const {
  const auto wall = std::chrono::steady_clock::now() - wall_start_;
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  StageReport report;
  report.name = std::move(name);
  report.wall_seconds = std::chrono::duration<double>(wall).count();
  report.cpu_seconds = CpuSeconds() - cpu_start_;
  // Linux counts in KiB.
  report.peak_memory_mb = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
  report.counts = std::move(counts);
  return report;
}

}  // namespace curvix
