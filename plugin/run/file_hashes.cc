// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/file_hashes.h"

#include <cstddef>
#include <fstream>
#include <string>

#include "base/cancelled.h"
#include "base/file_io.h"
#include "base/parallel.h"
#include "colmap/colmap_model.h"
#include "io/stage_file.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// Goes on from `hash` with the bytes of a file and their number.
Status AddFile(const fs::path& path, std::uint64_t& hash) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return Status::NotFound("Cannot open " + path.string() +
                            "; check that it may be read");
  }
  constexpr std::size_t kBlock = 1 << 20;
  std::uint64_t num_bytes = 0;
  while (file) {
    const std::string bytes = ReadUpTo(file, kBlock);
    hash = HashBytes(bytes, hash);
    num_bytes += bytes.size();
  }
  if (file.bad()) {
    return Status::DataLoss("Cannot read " + path.string() +
                            " to its end; copy it again");
  }
  hash = HashBytes(":" + std::to_string(num_bytes), hash);
  return {};
}

Result<std::uint64_t> HashFiles(const std::vector<fs::path>& paths) {
  std::uint64_t hash = HashBytes("");
  for (const fs::path& path : paths) {
    CURVIX_RETURN_IF_ERROR(AddFile(path, hash));
  }
  return hash;
}

}  // namespace

Result<std::vector<std::uint64_t>> HashImages(const Scene& scene,
                                              int num_threads,
                                              RunProgress& progress) {
  constexpr const char* kName = "hash_images";
  const std::size_t num_views = scene.views.size();
  std::vector<std::uint64_t> hashes(num_views);
  std::vector<Status> statuses(num_views);
  progress.Update(kName, 0, 0);
  ParallelForWhile(
      num_views,
      num_threads,
      [&](std::size_t i) {
        const View& view = scene.views[i];
        std::vector<fs::path> paths = {view.image_path};
        if (!view.mask_path.empty()) paths.push_back(view.mask_path);
        const Result<std::uint64_t> hash = HashFiles(paths);
        if (hash.ok()) hashes[i] = *hash;
        statuses[i] = hash.status();
        return hash.ok();
      },
      [&](std::size_t num_done) {
        return progress.Update(
            kName, static_cast<int>(num_done), static_cast<int>(num_views));
      });
  for (const Status& status : statuses) {
    if (!status.ok()) return status;
  }
  if (progress.IsCancelled()) return CancelledStatus();
  progress.Finish("");
  return hashes;
}

std::uint64_t HashOf(const std::vector<std::uint64_t>& hashes) {
  std::string text;
  for (const std::uint64_t hash : hashes) text += std::to_string(hash) + ' ';
  return HashBytes(text);
}

Result<std::uint64_t> HashModel(const fs::path& folder) {
  CURVIX_ASSIGN_OR_RETURN(const ColmapFormat format, FindColmapFormat(folder));
  const char* extension = format == ColmapFormat::kText ? ".txt" : ".bin";
  std::vector<fs::path> paths;
  for (const char* name : {"cameras", "images", "points3D"}) {
    const fs::path path = folder / (std::string(name) + extension);
    if (fs::exists(path)) paths.push_back(path);
  }
  return HashFiles(paths);
}

}  // namespace curvix
