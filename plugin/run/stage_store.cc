// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/stage_store.h"

#include <curvix/reconstruct.h>
#include <dlfcn.h>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "base/option_table.h"
#include "io/stage_file.h"
#include "plugin/run/run_report.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// Hashes one thing after the other; texts with their end.
class KeyMaker {
 public:
  void Add(std::string_view text) {
    hash_ = HashBytes(text, hash_);
    hash_ = HashBytes(std::string_view("\0", 1), hash_);
  }
  // Bit by bit.
  template <typename T>
  requires std::is_arithmetic_v<T>
  void Add(T value) {
    hash_ = HashBytes({reinterpret_cast<const char*>(&value), sizeof(value)},
                      hash_);
  }
  // A file by its path, size and time of last change.
  void AddFile(const fs::path& path) {
    std::error_code error;
    Add(fs::absolute(path, error).string());
    if (path.empty()) return;
    Add(static_cast<std::uint64_t>(fs::file_size(path, error)));
    Add(static_cast<std::int64_t>(
        fs::last_write_time(path, error).time_since_epoch().count()));
  }
  // The options whose section has this name.
  void AddOptions(const Options& options, const std::string& section) {
    Options copy = options;
    for (const OptionRow& row : OptionTable(copy)) {
      if (row.section != section) continue;
      Add(FullName(row));
      Add(ValueText(row));
    }
  }
  std::uint64_t key() const { return hash_; }

 private:
  std::uint64_t hash_ = HashBytes("");
};

// Another build of the program or its library may give another result.
void AddProgram(KeyMaker& key) {
  key.Add(ProgramVersion());
  std::error_code error;
  key.AddFile(fs::read_symlink("/proc/self/exe", error));
  Dl_info library;
  if (dladdr(reinterpret_cast<const void*>(&HashBytes), &library) == 0) return;
  // The program itself, by whatever name it was called, if that holds it all.
  const fs::path path = fs::canonical(library.dli_fname, error);
  if (!error) key.AddFile(path);
}

void AddPose(const Rigid3& pose, KeyMaker& key) {
  for (int i = 0; i < 4; ++i) key.Add(pose.rotation.coeffs()[i]);
  for (int i = 0; i < 3; ++i) key.Add(pose.translation[i]);
}

void AddCameras(const Scene& scene, KeyMaker& key) {
  for (const Camera& camera : scene.cameras) {
    key.Add(static_cast<int>(camera.model));
    key.Add(camera.width);
    key.Add(camera.height);
    for (const double param : camera.params) key.Add(param);
  }
}

// Poses and points.
void AddGeometry(const Scene& scene, KeyMaker& key) {
  for (const View& view : scene.views) AddPose(view.cam_from_world, key);
  for (const ScenePoint& point : scene.points) {
    for (int i = 0; i < 3; ++i) key.Add(point.position[i]);
    for (const int view_idx : point.view_idxs) key.Add(view_idx);
  }
}

void AddPixels(const Scene& scene, KeyMaker& key) {
  for (const ScenePoint& point : scene.points) {
    for (const Eigen::Vector2d& pixel : point.pixels) {
      key.Add(pixel.x());
      key.Add(pixel.y());
    }
  }
}

}  // namespace

std::uint64_t SceneKey(const Scene& scene) {
  KeyMaker key;
  AddCameras(scene, key);
  for (const View& view : scene.views) {
    key.Add(view.name);
    key.Add(view.camera_idx);
  }
  AddGeometry(scene, key);
  return key.key();
}

std::uint64_t AdjustmentKey(const Scene& scene, const fs::path& program) {
  KeyMaker key;
  AddProgram(key);
  key.AddFile(program);
  key.Add(SceneKey(scene));
  AddPixels(scene, key);
  return key.key();
}

std::uint64_t EdgesKey(const Scene& scene, const Options& options) {
  KeyMaker key;
  AddProgram(key);
  AddCameras(scene, key);
  for (const View& view : scene.views) {
    key.Add(view.camera_idx);
    key.AddFile(view.image_path);
    key.AddFile(view.mask_path);
  }
  key.AddOptions(options, "EdgeDetection");
  return key.key();
}

std::uint64_t SketchKey(const Scene& scene, const Options& options) {
  KeyMaker key;
  key.Add(EdgesKey(scene, options));
  AddGeometry(scene, key);
  for (const char* section : {"Hypotheses", "Consolidation", "Validation"}) {
    key.AddOptions(options, section);
  }
  key.Add(options.curve_growth.enabled);
  key.Add(options.curve_growth.max_crowding);  // texture gives no seeds
  return key.key();
}

std::uint64_t CurvePosesKey(const Scene& scene,
                            const Options& options,
                            bool refine_intrinsics) {
  KeyMaker key;
  key.Add(SketchKey(scene, options));
  key.Add(static_cast<int>(refine_intrinsics));
  AddPixels(scene, key);
  return key.key();
}

bool StageStore::IsLink() const {
  std::error_code error;
  return fs::is_symlink(folder_, error);
}

std::string StageStore::MakeFolder() const {
  if (IsLink()) return folder_.string() + " is a link";
  std::error_code error;
  fs::create_directories(folder_, error);
  return error ? "cannot make " + folder_.string() : "";
}

void StageStore::KeepText(const fs::path& path) const {
  if (folder_.empty() || IsLink()) return;
  const Result<std::string> text = ReadFile(path);
  if (!text.ok()) return;
  const Status ignored = WriteFileAtomically(folder_ / path.filename(), *text);
}

void StageStore::FetchText(const fs::path& path) const {
  if (folder_.empty()) return;
  const Result<std::string> text = ReadFile(folder_ / path.filename());
  if (!text.ok()) return;
  const Status ignored = WriteFileAtomically(path, *text);
}

void StageStore::Clean() {
  if (folder_.empty() || IsLink()) return;
  std::error_code ignored;
  for (const char* file : {kRefinePoses.file,
                           kAdjustmentLog,
                           kDetectEdges.file,
                           kSketchEdges.file,
                           kRefinePosesWithCurves.file}) {
    fs::remove(folder_ / file, ignored);
    FileWriter::RemoveLeftovers(folder_ / file);
  }
  fs::remove(folder_, ignored);
}

}  // namespace curvix
