// SPDX-License-Identifier: BSD-3-Clause
// The stages of a reconstruction, kept for a later run to go on from, and what
// they count.
#pragma once

#include <curvix/edges.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "colmap/colmap_model.h"
#include "plugin/base/progress.h"
#include "plugin/poses/pose_refinement.h"
#include "plugin/run/run_report.h"
#include "plugin/run/stage_store.h"

namespace curvix {

// What the stages of a scene give.
struct SceneStages {
  Scene scene;  // with the poses and cameras that the curves are made with
  std::vector<EdgeMap> edge_maps;            // one per view
  std::optional<ColmapModel> refined_model;  // if curves have refined it
  Reconstruction reconstruction;
};

// Runs stages with the options of `record`, and tells it and `progress` what
// they did. Both outlive it.
class RunStages {
 public:
  // `folder`: where results of stages are kept, unless it is empty or the run
  // is to be clean; they are only read where `images_key` is the same.
  RunStages(std::filesystem::path folder,
            RunProgress& progress,
            RunRecord& record,
            std::uint64_t images_key = 0);

  // Poses by bundle adjustment, if they are better; see RefinePoses().
  Result<PoseRefinement> AdjustPoses(const ColmapModel& model,
                                     const std::filesystem::path& log_path);

  // Edges, unless `edges` has them, one map per view, whose neighbours are
  // looked for as among detected ones; poses refined with curves, if
  // record.settings says so; and curves. `model`: whose views with images
  // `scene` has, and its points by their ids. Errors as ReconstructCurves; that
  // of an interrupted run tells what is kept.
  Result<SceneStages> Run(const ColmapModel& model,
                          Scene scene,
                          const std::vector<EdgeMap>* edges);

 private:
  Result<BundleAdjustment> LoadOrAdjust(
      const Scene& scene,
      const std::filesystem::path& program,
      const std::function<Result<BundleAdjustment>()>& adjust,
      const std::filesystem::path& log_path);
  Result<std::vector<EdgeMap>> Detect(const Scene& scene);
  std::vector<EdgeMap> Link(std::vector<EdgeMap> edge_maps);
  Status RefinePoses(const ColmapModel& model, SceneStages& stages);
  Result<Reconstruction> Reconstruct(const Scene& scene,
                                     const std::vector<EdgeMap>& edge_maps);
  // What to say when the run is interrupted now: `status`, and what is kept.
  Status KeptStages(Status status) const;
  Result<EdgeSketch> Sketch(const Scene& scene,
                            const std::vector<EdgeMap>& edge_maps);
  void FinishEdges(const Stopwatch& stopwatch,
                   const std::vector<EdgeMap>& edge_maps);
  void FinishStage(StageReport report, std::string text);
  template <typename T, typename Make>
  Result<T> LoadOrMake(const StoredStage<T>& stage,
                       std::uint64_t key,
                       const Make& make);

  StageStore store_;
  RunProgress& progress_;
  RunRecord& record_;
};

}  // namespace curvix
