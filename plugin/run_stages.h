// SPDX-License-Identifier: BSD-3-Clause
// The stages of a reconstruction, kept for a later run to go on from.
#pragma once

#include <curvix/edge_sketch.h>
#include <curvix/edges.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <curvix/status.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "plugin/colmap_model.h"
#include "plugin/curve_poses.h"
#include "plugin/progress.h"
#include "plugin/run_counts.h"
#include "plugin/run_report.h"
#include "plugin/stage_store.h"

namespace curvix {

// Runs stages with the options of `record`, and tells it and `progress` what
// they did. Both outlive it.
class RunStages {
 public:
  // `folder`: where results of stages are kept, unless the run is to be clean.
  RunStages(std::filesystem::path folder,
            ProgressPrinter& progress,
            RunRecord& record);

  Result<std::vector<EdgeMap>> Detect(const Scene& scene);
  // For `model`, whose views with images `scene` has.
  Result<CurvePoseRefinement> RefinePosesWithCurves(
      const ColmapModel& model,
      const Scene& scene,
      const std::vector<EdgeMap>& edge_maps);
  Result<Reconstruction> Reconstruct(const Scene& scene,
                                     const std::vector<EdgeMap>& edge_maps);

  // What to say when the run is interrupted now: `status`, and what is kept.
  Status KeptStages(Status status) const;

 private:
  Result<EdgeSketch> Sketch(const Scene& scene,
                            const std::vector<EdgeMap>& edge_maps);
  void FinishStage(StageReport report,
                   StageCounts counts,
                   std::string text,
                   bool is_resumed);
  template <typename T>
  void Save(std::uint64_t key, const T& result);

  StageStore store_;
  ProgressPrinter& progress_;
  RunRecord& record_;
};

}  // namespace curvix
