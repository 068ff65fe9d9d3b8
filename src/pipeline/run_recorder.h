// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Clock, counters and progress around the stages.
#pragma once

#include <curvix/reconstruct.h>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "base/cancelled.h"
#include "base/stopwatch.h"

namespace curvix {

StageCounts CountsOf(const CurveSet& curves);

// How many samples are of each kind.
StageCounts KindCounts(const CurveSet& curves);

// Records one stage after the other. Once the progress callback returns false,
// the run is cancelled, and no further stage is to begin.
class RunRecorder {
 public:
  explicit RunRecorder(const Progress& progress) : progress_(progress) {}

  // Both release what has been freed. False: the run is cancelled.
  [[nodiscard]] bool Begin(const std::string& stage);
  void End(StageCounts counts);

  // A callback for a stage that counts its own steps.
  StepDone Steps();

  // Calls f(i) for all i, reports progress in between, and returns the failure
  // of the smallest index, or kCancelled.
  Status ForEach(std::size_t n,
                 int num_threads,
                 const std::function<Status(std::size_t)>& f);

  bool cancelled() const { return cancelled_; }
  Report TakeReport() { return std::move(report_); }

 private:
  bool Tell(int done, int total);

  const Progress& progress_;
  Report report_;
  std::string stage_;
  Stopwatch stopwatch_;
  bool cancelled_ = false;
};

}  // namespace curvix
