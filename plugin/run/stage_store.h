// SPDX-License-Identifier: BSD-3-Clause
// Results of finished stages, kept beside the output for a later run to go on
// from.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/refine_poses.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/file_io.h"
#include "io/stage_io.h"

namespace curvix {

// Stands for cameras, views and points, not for images.
std::uint64_t SceneKey(const Scene& scene);

// What bundle adjustment of a scene depends on: its cameras, poses and points,
// and the program.
std::uint64_t AdjustmentKey(const Scene& scene,
                            const std::filesystem::path& program);

// What the edges of a scene depend on: the program, the images and masks (by
// path, size and time of last change), the cameras and
// Options::edge_detection. Not the poses.
std::uint64_t EdgesKey(const Scene& scene, const Options& options);

// What its 3D edge sketch depends on: that, and the poses, the points, the
// options of hypotheses, consolidation and validation, whether curves may grow
// from it, and CurveGrowth.max_crowding. Poses refined with curves depend on
// the same, of the scene before.
std::uint64_t SketchKey(const Scene& scene, const Options& options);
std::uint64_t CurvePosesKey(const Scene& scene,
                            const Options& options,
                            bool refine_intrinsics);

// A stage that takes long, and the file of its results.
template <typename T>
struct StoredStage {
  const char* name;
  const char* file;
};
// What COLMAP said when it made adjustment.bin.
inline constexpr char kAdjustmentLog[] = "bundle_adjuster.log";
inline constexpr StoredStage<BundleAdjustment> kRefinePoses = {
    "refine_poses", "adjustment.bin"};
inline constexpr StoredStage<std::vector<EdgeMap>> kDetectEdges = {
    "detect_edges", "edges.bin"};
inline constexpr StoredStage<EdgeSketch> kSketchEdges = {"sketch_edges",
                                                         "sketch.bin"};
inline constexpr StoredStage<CurvePoses> kRefinePosesWithCurves = {
    "refine_poses_with_curves", "curve_poses.bin"};

// Their files in a folder; with an empty path there are none. A file that
// another key was meant for, or that is broken, is as good as none. All keys
// also depend on `images_key`, if the bytes of images are known by a hash. If
// the folder is a link, nothing is written or removed behind it.
class StageStore {
 public:
  explicit StageStore(std::filesystem::path folder,
                      std::uint64_t images_key = 0)
      : folder_(std::move(folder)), images_key_(images_key) {}

  template <typename T>
  std::optional<T> Load(const StoredStage<T>& stage, std::uint64_t key) const {
    if (folder_.empty()) return std::nullopt;
    Result<T> result =
        ReadStageResult<T>(folder_ / stage.file, key ^ images_key_);
    if (!result.ok()) return std::nullopt;
    return *std::move(result);
  }

  // A sentence why it could not be saved, or "": a run can do without.
  template <typename T>
  std::string Save(const StoredStage<T>& stage,
                   std::uint64_t key,
                   const T& result) {
    if (folder_.empty()) return "";
    if (std::string why = MakeFolder(); !why.empty()) return why;
    FileWriter::RemoveLeftovers(folder_ / stage.file);
    const Status status =
        WriteStageResult(folder_ / stage.file, key ^ images_key_, result);
    has_saved_ = has_saved_ || status.ok();
    return status.message();
  }

  // Copies a file of a few pages, such as a log, into the folder under its own
  // name, or back from there, if it is there. A run can do without.
  void KeepText(const std::filesystem::path& path) const;
  void FetchText(const std::filesystem::path& path) const;

  // Whether anything was saved.
  bool has_saved() const { return has_saved_; }

  // Removes the files, and the folder if nothing else is in it.
  void Clean();

 private:
  bool IsLink() const;
  std::string MakeFolder() const;

  std::filesystem::path folder_;
  std::uint64_t images_key_;
  bool has_saved_ = false;
};

}  // namespace curvix
