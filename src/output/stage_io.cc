// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Results of stages to and from files.
#include <curvix/file_io.h>
#include <curvix/stage_io.h>

#include <cstddef>
#include <fstream>
#include <optional>
#include <string>

#include "output/byte_stream.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// "CVXSTAGE" in the byte order of the machine.
constexpr std::uint64_t kMagic = 0x4547415453585643;
constexpr std::uint32_t kVersion = 2;
enum class Kind : std::uint32_t {
  kEdgeMaps = 1,
  kEdgeSketch = 2,
  kPartResult = 3
};

constexpr std::size_t kHeadBytes = 40;
constexpr std::size_t kEdge2dBytes = 28;
constexpr std::size_t kLinkedEdge2dBytes = kEdge2dBytes + 8;
constexpr std::size_t kEdgeMapBytes = 28;  // without edges
constexpr std::size_t kEdge3dBytes = 72;   // without support
constexpr std::size_t kEdgeRefBytes = 8;

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

struct Head {
  std::uint64_t num_bytes = 0;  // that follow
  std::uint64_t checksum = 0;   // of these
};

// The head with which `bytes` begin.
Result<Head> ReadHead(const fs::path& path,
                      std::string_view bytes,
                      Kind kind,
                      std::uint64_t key) {
  ByteReader in(bytes);
  const bool is_stage = in.Take<std::uint64_t>() == kMagic &&
                        in.Take<std::uint32_t>() == kVersion;
  const bool is_kind =
      in.Take<std::uint32_t>() == static_cast<std::uint32_t>(kind);
  const bool is_key = in.Take<std::uint64_t>() == key;
  Head head;
  head.num_bytes = in.Take<std::uint64_t>();
  head.checksum = in.Take<std::uint64_t>();
  if (!in.ok()) return Broken(path);
  if (!is_stage || !is_kind || !is_key) return Other(path);
  return head;
}

// The content of the file after its head.
Result<std::string> ReadStage(const fs::path& path,
                              Kind kind,
                              std::uint64_t key) {
  Result<std::string> bytes = ReadFile(path);
  if (!bytes.ok()) return bytes;
  const Result<Head> head = ReadHead(path, *bytes, kind, key);
  if (!head.ok()) return head.status();
  bytes->erase(0, kHeadBytes);
  if (bytes->size() != head->num_bytes || HashBytes(*bytes) != head->checksum) {
    return Broken(path);
  }
  return bytes;
}

// Up to so many of the bytes that come next.
std::string ReadSome(std::istream& in, std::size_t num_bytes) {
  std::string bytes(num_bytes, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(num_bytes));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

// Whether what follows is what the head says.
bool HasContent(std::istream& in, const Head& head) {
  constexpr std::size_t kChunk = 1 << 20;
  std::uint64_t num_bytes = 0;
  std::uint64_t hash = HashBytes("");
  while (in) {
    const std::string bytes = ReadSome(in, kChunk);
    num_bytes += bytes.size();
    hash = HashBytes(bytes, hash);
  }
  in.clear();
  return num_bytes == head.num_bytes && hash == head.checksum;
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

void Put(const TracedCurve& traced, ByteWriter& out) {
  const Curve& curve = traced.curve;
  out.Put(static_cast<std::uint8_t>(curve.closed));
  out.Put(static_cast<std::uint8_t>(curve.is_occluding_contour));
  out.PutCount(curve.samples.size());
  for (const CurveSample& sample : curve.samples) PutEdge(sample, out);
  out.PutCount(traced.edges.size());
  for (const Edge2d& edge : traced.edges) Put(edge, out);
}

TracedCurve TakeTracedCurve(ByteReader& in) {
  TracedCurve traced;
  traced.curve.closed = in.Take<std::uint8_t>() != 0;
  traced.curve.is_occluding_contour = in.Take<std::uint8_t>() != 0;
  traced.curve.samples.resize(in.TakeCount(kEdge3dBytes));
  for (CurveSample& sample : traced.curve.samples) {
    sample = TakeEdge<CurveSample>(in);
  }
  traced.edges.resize(in.TakeCount(kEdge2dBytes));
  for (Edge2d& edge : traced.edges) edge = TakeEdge2d(in);
  return traced;
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
  ByteWriter head;
  head.Put(part.num_own_edges_2d);
  head.Put(part.num_core_edges_3d);
  head.PutCount(part.curves.size());
  ByteWriter curves;
  for (const TracedCurve& curve : part.curves) {
    const std::size_t begin = curves.bytes().size();
    Put(curve, curves);
    head.PutCount(curves.bytes().size() - begin);
  }
  return WriteStage(
      path, Kind::kPartResult, key, head.bytes() + curves.bytes());
}

Result<PartFile> PartFile::Open(const fs::path& path, std::uint64_t key) {
  PartFile file(path);
  file.stream_.open(path, std::ios::binary);
  if (!file.stream_) {
    return Status(StatusCode::kNotFound, "Cannot open " + path.string() + ".");
  }
  const Result<Head> head = ReadHead(
      path, ReadSome(file.stream_, kHeadBytes), Kind::kPartResult, key);
  if (!head.ok()) return head.status();
  if (!HasContent(file.stream_, *head)) return Broken(path);

  constexpr std::size_t kCountsBytes = 24;
  file.stream_.seekg(kHeadBytes);
  const std::string counts = ReadSome(file.stream_, kCountsBytes);
  ByteReader in(counts);
  file.num_own_edges_2d_ = in.Take<std::int64_t>();
  file.num_core_edges_3d_ = in.Take<std::int64_t>();
  const auto num_curves = in.Take<std::uint64_t>();
  constexpr std::size_t kSizeBytes = 8;
  if (!in.ok() || num_curves > head->num_bytes / kSizeBytes) {
    return Broken(path);
  }
  const std::string sizes = ReadSome(file.stream_, kSizeBytes * num_curves);
  in = ByteReader(sizes);
  std::uint64_t offset = kHeadBytes + kCountsBytes + sizes.size();
  const std::uint64_t end = kHeadBytes + head->num_bytes;
  file.offsets_.push_back(offset);
  for (std::uint64_t i = 0; i < num_curves; ++i) {
    const auto size = in.Take<std::uint64_t>();
    if (offset > end || size > end - offset) return Broken(path);
    file.offsets_.push_back(offset += size);
  }
  if (!in.AtEnd() || offset != end) return Broken(path);
  return file;
}

Result<TracedCurve> PartFile::Read(std::size_t curve_idx) {
  if (!stream_.is_open()) stream_.open(path_, std::ios::binary);
  stream_.clear();
  const std::uint64_t begin = offsets_.at(curve_idx);
  const std::uint64_t end = offsets_.at(curve_idx + 1);
  stream_.seekg(static_cast<std::streamoff>(begin));
  const std::string bytes = ReadSome(stream_, end - begin);
  ByteReader in(bytes);
  TracedCurve curve = TakeTracedCurve(in);
  if (bytes.size() != end - begin || !in.AtEnd()) return Broken(path_);
  return curve;
}

}  // namespace curvix
