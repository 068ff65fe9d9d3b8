// SPDX-License-Identifier: BSD-3-Clause
// A scene in parts, on disk: parts/ among the results.
//
//   plan.json         the partition, for people too
//   scene/*.bin       the model of the scene without its points
//   <k>/sparse/*.bin  the model of part k: its views, and the points they see
//   <k>/part.bin      what part k gave (curvix/stage_io.h)
//   <k>/edges.ply     the 3D edges in its core
//   <k>/report.json   what it cost
//   <k>/stages/       what it goes on from if it is run again
#pragma once

#include <curvix/options.h>
#include <curvix/parts.h>
#include <curvix/scene.h>
#include <curvix/status.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "plugin/colmap_model.h"

namespace curvix {

// Writes all of the above that is known before any part is reconstructed.
// `scene` is that of `model`, with the views whose images are there.
Status WritePlan(const ScenePartition& partition,
                 const Scene& scene,
                 const ColmapModel& model,
                 const std::filesystem::path& folder);

// The text of plan.json.
std::string PlanJson(const ScenePartition& partition, const Scene& scene);

struct PartPlan {
  std::string text;  // of plan.json
  ScenePartition partition;
  std::size_t num_views = 0;  // of the scene
};

// kNotFound without plan.json; kDataLoss if it is broken.
Result<PartPlan> ReadPlan(const std::filesystem::path& folder);

// What a part's result depends on besides the images: the plan and all options
// of its stages.
std::uint64_t PartKey(const PartPlan& plan,
                      int part_idx,
                      const Options& options);

std::filesystem::path PartFolder(const std::filesystem::path& folder,
                                 int part_idx);

}  // namespace curvix
