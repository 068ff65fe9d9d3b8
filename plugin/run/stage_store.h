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

namespace curvix {

// Stands for cameras, views and points, not for images.
std::uint64_t SceneKey(const Scene& scene);

// What the edges of a scene depend on: the program, the images and masks (by
// path, size and time of last change), the cameras and
// Options::edge_detection. Not the poses.
std::uint64_t EdgesKey(const Scene& scene, const Options& options);

// What its 3D edge sketch depends on: that, and the poses, the points, the
// options of hypotheses, consolidation and validation, and whether curves may
// grow from it. Poses refined with curves depend on the same, of the scene
// before.
std::uint64_t SketchKey(const Scene& scene, const Options& options);
std::uint64_t CurvePosesKey(const Scene& scene,
                            const Options& options,
                            bool refine_intrinsics);

// The stages that take long: files in a folder; with an empty path there are
// none. A file that another key was meant for, or that is broken, is as good as
// none. If the folder is a link, nothing is written or removed behind it.
class StageStore {
 public:
  explicit StageStore(std::filesystem::path folder)
      : folder_(std::move(folder)) {}

  std::optional<std::vector<EdgeMap>> LoadEdges(std::uint64_t key) const;
  std::optional<EdgeSketch> LoadSketch(std::uint64_t key) const;
  std::optional<CurvePoses> LoadCurvePoses(std::uint64_t key) const;

  // A sentence why it could not be saved, or "": a run can do without.
  std::string Save(std::uint64_t key, const std::vector<EdgeMap>& edge_maps);
  std::string Save(std::uint64_t key, const EdgeSketch& sketch);
  std::string Save(std::uint64_t key, const CurvePoses& poses);

  // Whether anything was saved.
  bool has_saved() const { return has_saved_; }

  // Removes the files, and the folder if nothing else is in it.
  void Clean();

 private:
  bool IsLink() const;
  std::string MakeFolder() const;
  template <typename T>
  std::optional<T> LoadBy(Result<T> read(const std::filesystem::path&,
                                         std::uint64_t),
                          const char* name,
                          std::uint64_t key) const;
  template <typename T>
  std::string SaveBy(Status write(const std::filesystem::path&,
                                  std::uint64_t,
                                  const T&),
                     const char* name,
                     std::uint64_t key,
                     const T& result);

  std::filesystem::path folder_;
  bool has_saved_ = false;
};

}  // namespace curvix
