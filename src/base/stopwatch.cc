// SPDX-License-Identifier: BSD-3-Clause
#include "base/stopwatch.h"

#include <sys/resource.h>
#include <utility>

namespace curvix {
namespace {

rusage Usage() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) +
         1e-6 * static_cast<double>(time.tv_usec);
}

double CpuSeconds() {
  const rusage usage = Usage();
  return Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
}

}  // namespace

Stopwatch::Stopwatch()
    : wall_start_(std::chrono::steady_clock::now()), cpu_start_(CpuSeconds()) {}

StageReport Stopwatch::Read(std::string name) const {
  const auto wall = std::chrono::steady_clock::now() - wall_start_;
  StageReport report;
  report.name = std::move(name);
  report.wall_seconds = std::chrono::duration<double>(wall).count();
  report.cpu_seconds = CpuSeconds() - cpu_start_;
  // Linux counts in KiB.
  report.peak_memory_mb = static_cast<double>(Usage().ru_maxrss) * 1024 / 1e6;
  return report;
}

}  // namespace curvix
