// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Results of stages to and from files.
#include <curvix/file_io.h>
#include <curvix/stage_io.h>

#include <algorithm>
#include <optional>
#include <string>

#include "output/byte_stream.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// "CVXSTAGE" in the byte order of the machine.
constexpr std::uint64_t kMagic = 0x4547415453585643;
constexpr std::uint32_t kVersion = 1;
enum class Kind : std::uint32_t {
  kEdgeMaps = 1,
  kEdgeSketch = 2,
  kPartResult = 3
};

constexpr std::size_t kEdge2dBytes = 28;
constexpr std::size_t kLinkedEdge2dBytes = kEdge2dBytes + 8;
constexpr std::size_t kEdgeMapBytes = 28;  // without edges
constexpr std::size_t kEdge3dBytes = 72;   // without support
constexpr std::size_t kEdgeRefBytes = 8;
constexpr std::size_t kCurveBytes = 10;  // without samples

Status WriteStage(const fs::path& path,
                  Kind kind,
                  std::uint64_t key,
                  const std::string& content) {
  ByteWriter file;
  file.Put(kMagic);
  file.Put(kVersion);
  file.Put(static_cast<std::uint32_t>(kind));
  file.Put(key);
  file.PutCount(content.size());
  file.Put(HashBytes(content));
  return WriteFileAtomically(path, file.bytes() + content);
}

Status Broken(const fs::path& path) {
  return {StatusCode::kDataLoss,
          path.string() + " is broken or truncated; remove it."};
}

Status Other(const fs::path& path) {
  return {StatusCode::kNotFound,
          path.string() + " is the result of another input, of other options " +
              "or of another program."};
}

// The content of the file after its head.
Result<std::string> ReadStage(const fs::path& path,
                              Kind kind,
                              std::uint64_t key) {
  Result<std::string> bytes = ReadFile(path);
  if (!bytes.ok()) return bytes;
  ByteReader head(*bytes);
  const bool is_stage = head.Take<std::uint64_t>() == kMagic &&
                        head.Take<std::uint32_t>() == kVersion;
  const bool is_kind =
      head.Take<std::uint32_t>() == static_cast<std::uint32_t>(kind);
  const bool is_key = head.Take<std::uint64_t>() == key;
  const auto size = head.Take<std::uint64_t>();
  const auto checksum = head.Take<std::uint64_t>();
  if (!head.ok()) return Broken(path);
  if (!is_stage || !is_kind || !is_key) return Other(path);
  if (head.rest().size() != size || HashBytes(head.rest()) != checksum) {
    return Broken(path);
  }
  bytes->erase(0, bytes->size() - head.rest().size());
  return bytes;
}

void Put(const Eigen::Vector3d& x, ByteWriter& out) {
  for (int i = 0; i < 3; ++i) out.Put(x[i]);
}

Eigen::Vector3d TakeVector3(ByteReader& in) {
  Eigen::Vector3d x;
  for (int i = 0; i < 3; ++i) x[i] = in.Take<double>();
  return x;
}

// -1: none.
std::optional<std::int32_t> TakeNeighbor(ByteReader& in) {
  const auto edge_idx = in.Take<std::int32_t>();
  if (edge_idx == -1) return std::nullopt;
  return edge_idx;
}

void Put(const Edge2d& edge, ByteWriter& out) {
  out.Put(edge.position.x());
  out.Put(edge.position.y());
  out.Put(edge.angle);
  out.Put(edge.strength);
  out.Put(edge.sharpness);
}

Edge2d TakeEdge2d(ByteReader& in) {
  Edge2d edge;
  edge.position.x() = in.Take<double>();
  edge.position.y() = in.Take<double>();
  edge.angle = in.Take<float>();
  edge.strength = in.Take<float>();
  edge.sharpness = in.Take<float>();
  return edge;
}

void Put(const EdgeMap& map, ByteWriter& out) {
  out.PutCount(map.edges.size());
  out.Put(map.noise);
  out.Put(map.num_dropped_masked);
  out.Put(map.num_dropped_isolated);
  out.Put(map.num_dropped_over_limit);
  for (std::size_t i = 0; i < map.edges.size(); ++i) {
    const Edge2d& edge = map.edges[i];
    Put(edge, out);
    out.Put(map.neighbors[i].previous.value_or(-1));
    out.Put(map.neighbors[i].next.value_or(-1));
  }
}

EdgeMap TakeEdgeMap(ByteReader& in) {
  EdgeMap map;
  const std::size_t num_edges = in.TakeCount(kLinkedEdge2dBytes);
  map.noise = in.Take<double>();
  map.num_dropped_masked = in.Take<std::int32_t>();
  map.num_dropped_isolated = in.Take<std::int32_t>();
  map.num_dropped_over_limit = in.Take<std::int32_t>();
  map.edges.resize(num_edges);
  map.neighbors.resize(num_edges);
  for (std::size_t i = 0; i < num_edges; ++i) {
    map.edges[i] = TakeEdge2d(in);
    map.neighbors[i].previous = TakeNeighbor(in);
    map.neighbors[i].next = TakeNeighbor(in);
  }
  return map;
}

// Of Edge3d and CurveSample, which have the same fields.
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

void Put(const Curve& curve, ByteWriter& out) {
  out.PutCount(curve.samples.size());
  out.Put(static_cast<std::uint8_t>(curve.closed));
  out.Put(static_cast<std::uint8_t>(curve.is_occluding_contour));
  for (const CurveSample& sample : curve.samples) PutEdge(sample, out);
}

Curve TakeCurve(ByteReader& in) {
  Curve curve;
  curve.samples.resize(in.TakeCount(kEdge3dBytes));
  curve.closed = in.Take<std::uint8_t>() != 0;
  curve.is_occluding_contour = in.Take<std::uint8_t>() != 0;
  for (CurveSample& sample : curve.samples) {
    sample = TakeEdge<CurveSample>(in);
  }
  return curve;
}

// Whether all edges that the curves name are there.
bool IsConsistent(const PartResult& part) {
  const auto is_there = [&](const EdgeRef& ref) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    return ref.view_idx >= 0 && view_idx < part.edge_maps.size() &&
           ref.edge_idx >= 0 &&
           static_cast<std::size_t>(ref.edge_idx) <
               part.edge_maps[view_idx].edges.size();
  };
  for (const Curve& curve : part.curves) {
    for (const CurveSample& sample : curve.samples) {
      const auto& support = sample.support;
      if (!std::all_of(support.begin(), support.end(), is_there)) return false;
    }
  }
  return true;
}

}  // namespace

std::uint64_t HashBytes(std::string_view bytes, std::uint64_t hash) {
  for (const char c : bytes) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  return hash;
}

Status WriteEdgeMaps(const fs::path& path,
                     std::uint64_t key,
                     const std::vector<EdgeMap>& edge_maps) {
  ByteWriter out;
  std::size_t num_bytes = sizeof(std::uint64_t);
  for (const EdgeMap& map : edge_maps) {
    num_bytes += kEdgeMapBytes + kLinkedEdge2dBytes * map.edges.size();
  }
  out.Reserve(num_bytes);
  out.PutCount(edge_maps.size());
  for (const EdgeMap& map : edge_maps) Put(map, out);
  return WriteStage(path, Kind::kEdgeMaps, key, out.bytes());
}

Result<std::vector<EdgeMap>> ReadEdgeMaps(const fs::path& path,
                                          std::uint64_t key) {
  const Result<std::string> content = ReadStage(path, Kind::kEdgeMaps, key);
  if (!content.ok()) return content.status();
  ByteReader in(*content);
  std::vector<EdgeMap> edge_maps(in.TakeCount(kEdgeMapBytes));
  for (EdgeMap& map : edge_maps) map = TakeEdgeMap(in);
  if (!in.AtEnd()) return Broken(path);
  return edge_maps;
}

Status WriteEdgeSketch(const fs::path& path,
                       std::uint64_t key,
                       const EdgeSketch& sketch) {
  ByteWriter out;
  const SketchCounts& counts = sketch.counts;
  for (const std::int64_t count : {counts.view_pairs,
                                   counts.h1_edges,
                                   counts.hypotheses,
                                   counts.unsupported,
                                   counts.rivals,
                                   counts.used_edges}) {
    out.Put(count);
  }
  out.PutCount(sketch.edges.size());
  for (const Edge3d& edge : sketch.edges) PutEdge(edge, out);
  return WriteStage(path, Kind::kEdgeSketch, key, out.bytes());
}

Result<EdgeSketch> ReadEdgeSketch(const fs::path& path, std::uint64_t key) {
  const Result<std::string> content = ReadStage(path, Kind::kEdgeSketch, key);
  if (!content.ok()) return content.status();
  ByteReader in(*content);
  EdgeSketch sketch;
  SketchCounts& counts = sketch.counts;
  for (std::int64_t* count : {&counts.view_pairs,
                              &counts.h1_edges,
                              &counts.hypotheses,
                              &counts.unsupported,
                              &counts.rivals,
                              &counts.used_edges}) {
    *count = in.Take<std::int64_t>();
  }
  sketch.edges.resize(in.TakeCount(kEdge3dBytes));
  for (Edge3d& edge : sketch.edges) edge = TakeEdge<Edge3d>(in);
  if (!in.AtEnd()) return Broken(path);
  return sketch;
}

Status WritePartResult(const fs::path& path,
                       std::uint64_t key,
                       const PartResult& part) {
  ByteWriter out;
  out.PutCount(part.curves.size());
  for (const Curve& curve : part.curves) Put(curve, out);
  out.PutCount(part.edge_maps.size());
  for (const EdgeMap& map : part.edge_maps) {
    out.PutCount(map.edges.size());
    for (const Edge2d& edge : map.edges) Put(edge, out);
  }
  out.Put(part.num_own_edges_2d);
  out.Put(part.num_core_edges_3d);
  return WriteStage(path, Kind::kPartResult, key, out.bytes());
}

Result<PartResult> ReadPartResult(const fs::path& path, std::uint64_t key) {
  const Result<std::string> content = ReadStage(path, Kind::kPartResult, key);
  if (!content.ok()) return content.status();
  ByteReader in(*content);
  PartResult part;
  part.curves.resize(in.TakeCount(kCurveBytes));
  for (Curve& curve : part.curves) curve = TakeCurve(in);
  part.edge_maps.resize(in.TakeCount(sizeof(std::uint64_t)));
  for (EdgeMap& map : part.edge_maps) {
    map.edges.resize(in.TakeCount(kEdge2dBytes));
    for (Edge2d& edge : map.edges) edge = TakeEdge2d(in);
  }
  part.num_own_edges_2d = in.Take<std::int64_t>();
  part.num_core_edges_3d = in.Take<std::int64_t>();
  if (!in.AtEnd() || !IsConsistent(part)) return Broken(path);
  return part;
}

}  // namespace curvix
