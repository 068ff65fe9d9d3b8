// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Results of finished stages to and from files, bit
// by bit: a run that goes on from a file gives the same bytes as one that does
// not, on this machine or on another. stage_io.cc describes the files.
#pragma once

#include <curvix/edges.h>
#include <curvix/refine_poses.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "parts/scene_parts.h"

namespace curvix {

// What bundle adjustment by points gave for a scene.
struct BundleAdjustment {
  std::vector<Rigid3> cam_from_world;      // by view
  std::vector<Eigen::Vector3d> positions;  // by point
  std::string program_version;             // "3.8"; "unknown"
};

// T: std::vector<EdgeMap>, BundleAdjustment, EdgeSketch or CurvePoses. `key`
// stands for all that the result depends on; the caller chooses it. The file
// appears whole or not at all; errors of FileWriter.
template <typename T>
Status WriteStageResult(const std::filesystem::path& path,
                        std::uint64_t key,
                        const T& result);
Status WritePartResult(const std::filesystem::path& path,
                       std::uint64_t key,
                       const PartResult& part);

// kNotFound: no file, or one with another key, of another kind or version.
// kDataLoss: broken or truncated; a checksum tells, and no memory is taken on
// the word of a count. Indices of edge maps and sketches are not checked: they
// mean something together with a scene only.
template <typename T>
Result<T> ReadStageResult(const std::filesystem::path& path, std::uint64_t key);

// A file of WritePartResult, from which curves are read one by one. For one
// thread.
class PartFile {
 public:
  // Reads the file once to its end, to check it. Errors as above.
  static Result<PartFile> Open(const std::filesystem::path& path,
                               std::uint64_t key);

  std::size_t num_curves() const { return offsets_.size() - 1; }
  std::int64_t num_own_edges_2d() const { return num_own_edges_2d_; }
  std::int64_t num_core_edges_3d() const { return num_core_edges_3d_; }

  // kDataLoss: the file has changed since. Indices are not checked.
  Result<TracedCurve> Read(std::size_t curve_idx);
  // Until the next curve is read, so that of many files few are open.
  void Close() { stream_.close(); }

 private:
  explicit PartFile(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
  std::ifstream stream_;
  std::vector<std::uint64_t> offsets_;  // of the curves, and of the end
  std::int64_t num_own_edges_2d_ = 0;
  std::int64_t num_core_edges_3d_ = 0;
};

}  // namespace curvix
