// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_recorder.h"

#include <cstdint>
#include <vector>

#include "base/free_memory.h"
#include "base/parallel.h"

namespace curvix {

StageCounts CountsOf(const EdgeSketch& sketch) {
  const SketchCounts& c = sketch.counts;
  StageCounts counts = {
      {"view pairs", c.view_pairs},
      {"edges asked", c.h1_edges},
      {"hypotheses", c.hypotheses},
      {"hypotheses without support", c.unsupported},
      {"weaker rivals", c.rivals},
      {"3D edges", static_cast<std::int64_t>(sketch.edges.size())},
      {"2D edges used", c.used_edges}};
  if (c.repeated_views > 0) {
    counts.emplace(counts.begin(), "repeated views", c.repeated_views);
  }
  return counts;
}

StageCounts CountsOf(const CurveSet& curves) {
  std::int64_t num_samples = 0;
  for (const Curve& curve : curves.curves) {
    num_samples += static_cast<std::int64_t>(curve.samples.size());
  }
  return {{"curves", static_cast<std::int64_t>(curves.curves.size())},
          {"samples", num_samples}};
}

StageCounts KindCounts(const CurveSet& curves) {
  StageCounts counts;
  for (int kind = 0; kind < kNumCurveKinds; ++kind) {
    counts.emplace_back(KindName(static_cast<CurveKind>(kind)), 0);
  }
  for (const Curve& curve : curves.curves) {
    for (const CurveSample& sample : curve.samples) {
      ++counts[static_cast<std::size_t>(sample.kind)].second;
    }
  }
  return counts;
}

bool RunRecorder::Begin(const std::string& stage) {
  ReleaseFreeMemory();
  stage_ = stage;
  stopwatch_ = Stopwatch();
  return Tell(0, 0);
}

void RunRecorder::End(StageCounts counts) {
  report_.stages.push_back(stopwatch_.Read(stage_, std::move(counts)));
  // Before the result of the stage is saved, which takes memory.
  ReleaseFreeMemory();
}

bool RunRecorder::Tell(int done, int total) {
  if (!cancelled_ && progress_ && !progress_(stage_, done, total)) {
    cancelled_ = true;
  }
  return !cancelled_;
}

StepDone RunRecorder::Steps() {
  return [this](int done, int total) { return Tell(done, total); };
}

Status RunRecorder::ForEach(std::size_t n,
                            int num_threads,
                            const std::function<Status(std::size_t)>& f) {
  std::vector<Status> statuses(n);
  ParallelForWhile(
      n,
      num_threads,
      [&](std::size_t i) {
        statuses[i] = f(i);
        return statuses[i].ok();
      },
      [&](std::size_t done) {
        return Tell(static_cast<int>(done), static_cast<int>(n));
      });
  for (const Status& status : statuses) {
    if (!status.ok()) return status;
  }
  const auto total = static_cast<int>(n);
  return Tell(total, total) ? Status() : CancelledStatus();
}

}  // namespace curvix
