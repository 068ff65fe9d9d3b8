// SPDX-License-Identifier: BSD-3-Clause
// A scene in parts, on disk: parts/ among the results.
//
//   plan.json         the partition, for people too
//   input.json        the model that was divided: hash of its files, notes, and
//                     the images that it lacks
//   scene/*.bin       the model of the scene with some of its points
//   <k>/sparse/*.bin  the model of part k: its views, and the points they see
//   <k>/part.bin      what part k gave (io/stage_io.h)
//   <k>/edges.ply     the 3D edges in its core
//   <k>/report.json   what it cost
//   <k>/stages/       what it goes on from if it is run again
#pragma once

#include <curvix/options.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "colmap/colmap_model.h"
#include "io/stage_io.h"
#include "parts/scene_parts.h"
#include "plugin/base/progress.h"
#include "plugin/run/run_report.h"

namespace curvix {

// Writes plan.json and the models of the scene and of its parts. `scene` is
// that of `model`, with the views whose images are there.
Status WritePlan(const ScenePartition& partition,
                 const Scene& scene,
                 const ColmapModel& model,
                 const std::filesystem::path& folder);
// kNotFound if a model of WritePlan() is not there, or not whole.
Status CheckModelIsThere(const std::filesystem::path& folder);

// input.json. The model that was divided may be too large for the memory of a
// merge.
struct InputOfPlan {
  std::uint64_t model_hash = 0;  // HashModel() of its folder
  std::vector<std::string> missing_images;
  std::vector<std::string> notes;
};
Status WriteInputOfPlan(const InputOfPlan& input,
                        const std::filesystem::path& folder);
// kNotFound without the file; kDataLoss if it is broken.
Result<InputOfPlan> ReadInputOfPlan(const std::filesystem::path& folder);

// The text of plan.json.
std::string PlanJson(const ScenePartition& partition, const Scene& scene);

struct PartPlan {
  std::string text;  // of plan.json
  ScenePartition partition;
  std::size_t num_views = 0;  // of the scene
};

// kNotFound without plan.json; kDataLoss if it is broken.
Result<PartPlan> ReadPlan(const std::filesystem::path& folder);

// What a part's result depends on: the program, the plan, all options of its
// stages, and the images of its views by their hashes (file_hashes.h).
std::uint64_t PartKey(const PartPlan& plan,
                      int part_idx,
                      const Options& options,
                      const std::vector<std::uint64_t>& image_hashes);

std::filesystem::path PartFolder(const std::filesystem::path& folder,
                                 int part_idx);
// In the folder of a part.
constexpr const char* kPartResultName = "part.bin";
constexpr const char* kPartEdgesName = "edges.ply";

// The results of all parts, of which one file is open at a time.
class PartFiles : public PartResults {
 public:
  // Reads all files once, to check them. `image_hashes`: of all views of the
  // scene. kNotFound names all parts that are not there, broken or not under
  // their keys. `progress` outlives this.
  static Result<PartFiles> Open(const PartPlan& plan,
                                const Options& options,
                                const std::vector<std::uint64_t>& image_hashes,
                                const std::filesystem::path& folder,
                                RunProgress& progress);

  // Of all parts: edges detected, and 3D edges.
  std::int64_t num_edges_2d() const;
  std::int64_t num_edges_3d() const;

  std::size_t NumCurves(int part_idx) const override;
  // kCancelled, too, once the run is to stop.
  Result<TracedCurve> Read(int part_idx, std::size_t curve_idx) override;

  PartFiles(PartFiles&&) = default;

 private:
  explicit PartFiles(RunProgress& progress) : progress_(progress) {}

  RunProgress& progress_;
  std::vector<PartFile> files_;
  std::size_t open_ = 0;  // the one that may be open
};

}  // namespace curvix
