// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What the files of io/stage_io.h have in common:
// numbers in little endian, without padding; counts have 8 bytes. All begin
// with
//   8 bytes     CVXSTAGE
//   4, 4 bytes  format version; StageKind
//   8 bytes     key: hash of all that the result depends on
//   8, 8 bytes  number of bytes that follow; their 64-bit FNV-1a hash
#pragma once

#include <curvix/edges.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/bytes.h"

namespace curvix {

enum class StageKind : std::uint32_t {
  kEdgeMaps = 1,
  kEdgeSketch = 2,
  kPartResult = 3,
  kCurvePoses = 4,
  kBundleAdjustment = 5
};

constexpr std::size_t kStageHeadBytes = 40;

// A hash of bytes (64-bit FNV-1a), for keys and checksums; goes on from `hash`.
std::uint64_t HashBytes(std::string_view bytes,
                        std::uint64_t hash = 0xcbf29ce484222325);

// A head and the content. Errors as WriteStageResult.
Status WriteStage(const std::filesystem::path& path,
                  StageKind kind,
                  std::uint64_t key,
                  const std::string& content);

struct StageHead {
  std::uint64_t num_bytes = 0;  // that follow
  std::uint64_t checksum = 0;   // of these: HashBytes
};

// The head with which `bytes` of a file begin. Errors as ReadStageResult.
Result<StageHead> ReadStageHead(const std::filesystem::path& path,
                                std::string_view bytes,
                                StageKind kind,
                                std::uint64_t key);

// The content of the file after its head.
Result<std::string> ReadStage(const std::filesystem::path& path,
                              StageKind kind,
                              std::uint64_t key);

// kDataLoss.
Status BrokenStage(const std::filesystem::path& path);

// A list of fields serves both ways: Fields(archive, value) writes `value` with
// a StageWriter, which leaves it as it is, and reads it with a StageReader.
struct StageWriter : ByteWriter {
  static constexpr bool kReads = false;

  // Numbers.
  template <typename... T>
  void operator()(const T&... values) {
    (Put(values), ...);
  }
  // How many things of at least `min_bytes` each follow.
  void Count(const std::size_t& count, std::size_t /*min_bytes*/) {
    PutCount(count);
  }
};

struct StageReader : ByteReader {
  static constexpr bool kReads = true;
  using ByteReader::ByteReader;

  template <typename... T>
  void operator()(T&... values) {
    ((values = Take<T>()), ...);
  }
  void Count(std::size_t& count, std::size_t min_bytes) {
    count = TakeCount(min_bytes);
  }
};

template <typename Archive, typename Number>
requires std::is_arithmetic_v<Number>
void Fields(Archive& archive, Number& value) { archive(value); }

// What a StageWriter writes of a new T, whose lists are empty.
template <typename T>
std::size_t MinBytes() {
  static const std::size_t num_bytes = [] {
    static T zero;  // also where T() sets nothing
    StageWriter out;
    Fields(out, zero);
    return out.bytes().size();
  }();
  return num_bytes;
}

// How many there are, and these.
template <typename Archive, typename T>
void List(Archive& archive, std::vector<T>& values) {
  std::size_t count = values.size();
  archive.Count(count, MinBytes<T>());
  values.resize(count);
  for (T& value : values) Fields(archive, value);
}

template <typename Archive>
void Fields(Archive& archive, Eigen::Vector3d& x) {
  archive(x[0], x[1], x[2]);
}

template <typename Archive>
void Fields(Archive& archive, Edge2d& edge) {
  archive(edge.position[0],
          edge.position[1],
          edge.angle,
          edge.strength,
          edge.sharpness,
          edge.level,
          edge.crowding,
          edge.fine_px);
}

template <typename Archive>
void Fields(Archive& archive, EdgeRef& ref) {
  archive(ref.view_idx, ref.edge_idx);
}

// What Edge3d and CurveSample have in common.
template <typename Archive, typename Edge>
void EdgeFields(Archive& archive, Edge& edge) {
  Fields(archive, edge.position);
  Fields(archive, edge.tangent);
  archive(edge.sigma, edge.evidence);
  List(archive, edge.support);
}

template <typename Archive>
void Fields(Archive& archive, Edge3d& edge) {
  EdgeFields(archive, edge);
}

}  // namespace curvix
