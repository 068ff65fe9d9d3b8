// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What the files of io/stage_io.h have in
// common: numbers as in memory (little endian on all supported machines),
// without padding; counts have 8 bytes. All begin with
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

#include "base/bytes.h"

namespace curvix {

enum class StageKind : std::uint32_t {
  kEdgeMaps = 1,
  kEdgeSketch = 2,
  kPartResult = 3,
  kCurvePoses = 4
};

constexpr std::size_t kStageHeadBytes = 40;
constexpr std::size_t kEdge2dBytes = 28;
constexpr std::size_t kEdge3dBytes = 72;  // without support
constexpr std::size_t kEdgeRefBytes = 8;

// A head and the content. Errors as WriteEdgeMaps.
Status WriteStage(const std::filesystem::path& path,
                  StageKind kind,
                  std::uint64_t key,
                  const std::string& content);

struct StageHead {
  std::uint64_t num_bytes = 0;  // that follow
  std::uint64_t checksum = 0;   // of these: HashBytes
};

// The head with which `bytes` of a file begin. Errors as ReadEdgeMaps.
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

inline void Put(const Eigen::Vector3d& x, ByteWriter& out) {
  for (int i = 0; i < 3; ++i) out.Put(x[i]);
}

inline Eigen::Vector3d TakeVector3(ByteReader& in) {
  Eigen::Vector3d x;
  for (int i = 0; i < 3; ++i) x[i] = in.Take<double>();
  return x;
}

inline void Put(const Edge2d& edge, ByteWriter& out) {
  out.Put(edge.position.x());
  out.Put(edge.position.y());
  out.Put(edge.angle);
  out.Put(edge.strength);
  out.Put(edge.sharpness);
  out.Put(edge.level);
}

inline Edge2d TakeEdge2d(ByteReader& in) {
  Edge2d edge;
  edge.position.x() = in.Take<double>();
  edge.position.y() = in.Take<double>();
  edge.angle = in.Take<float>();
  edge.strength = in.Take<float>();
  edge.sharpness = in.Take<float>();
  edge.level = in.Take<float>();
  return edge;
}

// What Edge3d and CurveSample have in common.
template <typename Edge>
void PutEdge(const Edge& edge, ByteWriter& out) {
  Put(edge.position, out);
  Put(edge.tangent, out);
  out.Put(edge.sigma);
  out.Put(edge.evidence);
  out.PutCount(edge.support.size());
  for (const EdgeRef& ref : edge.support) {
    out.Put(ref.view_idx);
    out.Put(ref.edge_idx);
  }
}

template <typename Edge>
Edge TakeEdge(ByteReader& in) {
  Edge edge;
  edge.position = TakeVector3(in);
  edge.tangent = TakeVector3(in);
  edge.sigma = in.Take<double>();
  edge.evidence = in.Take<double>();
  edge.support.resize(in.TakeCount(kEdgeRefBytes));
  for (EdgeRef& ref : edge.support) {
    ref.view_idx = in.Take<std::int32_t>();
    ref.edge_idx = in.Take<std::int32_t>();
  }
  return edge;
}

}  // namespace curvix
