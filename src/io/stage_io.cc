// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Results of stages to and from files, which after
// their head (stage_file.h) hold
//   edges.bin: number of views; per view: number of edges, noise, spacing in
//     pixels, gain of variance (doubles), edges dropped by the mask, as
//     isolated, over the limit (int32 each); number of cells and these (1 byte
//     each), their columns (int32), margin in pixels (double); per edge: x, y
//     (doubles), angle, strength, sharpness (floats), level, crowding, fine_px
//     (halves), indices of the previous and the next edge (int32, -1: none)
//   adjustment.bin: number of views; per view: rotation x, y, z, w and
//     translation (7 doubles); number of points; per point: position (3
//     doubles); length of the program's version, its text
//   sketch.bin: view pairs, edges asked, hypotheses, without support,
//     weaker alternatives, 2D edges used, repeated views (int64 each); edge
//     sigma in pixels (double); number of 3D edges; per edge: position, tangent
//     (3 doubles each), sigma, evidence (doubles), number of supports, per
//     support view and edge (int32 each)
//   curve_poses.bin: number of views; per view: as in adjustment.bin; number of
//     cameras; per camera: model, width, height (int32 each), number of
//     parameters, these (doubles); accepted (1 byte); length of the reason, its
//     text; counts and doubles in the order of Fields()
//   part.bin: number of 2D edges of the part's own views, of 3D edges in its
//     core, and of curves (8 bytes each); number of bytes of each curve (8
//     bytes each); per curve: closed (1 byte), number of samples; per sample
//     the fields of a 3D edge, its covariance (6 doubles: the upper triangle,
//     row by row), its kind (1 byte) and the probability of that (float);
//     number of 2D edges behind the curve, to which its supports refer, these
//     as in edges.bin but for neighbours
#include "io/stage_io.h"

#include <algorithm>
#include <istream>
#include <optional>

#include "base/file_io.h"
#include "io/stage_file.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

}  // namespace

// Found by List(), so in the namespace of what they describe.
template <typename Archive>
void Fields(Archive& archive, Rigid3& pose) {
  auto& q = pose.rotation.coeffs();
  archive(q[0], q[1], q[2], q[3]);
  Fields(archive, pose.translation);
}

template <typename Archive>
void Fields(Archive& archive, Camera& camera) {
  static_assert(sizeof(CameraModel) == sizeof(std::int32_t));
  auto model = static_cast<std::int32_t>(camera.model);
  archive(model, camera.width, camera.height);
  if constexpr (Archive::kReads) camera.model = static_cast<CameraModel>(model);
  List(archive, camera.params);
}

template <typename Archive>
void Fields(Archive& archive, std::optional<std::int32_t>& neighbor) {
  std::int32_t edge_idx = neighbor.value_or(-1);  // -1: none
  archive(edge_idx);
  if constexpr (Archive::kReads) {
    if (edge_idx != -1) neighbor = edge_idx;
  }
}

inline std::size_t LinkedEdgeBytes() {
  return MinBytes<Edge2d>() + 2 * MinBytes<std::optional<std::int32_t>>();
}

template <typename Archive>
void Fields(Archive& archive, EdgeMap& map) {
  std::size_t num_edges = map.edges.size();
  archive.Count(num_edges, LinkedEdgeBytes());
  archive(map.noise,
          map.spacing_px,
          map.fine_variance_gain_px2,
          map.num_dropped_masked,
          map.num_dropped_isolated,
          map.num_dropped_over_limit);
  List(archive, map.unseen.cells);
  archive(map.unseen.num_columns, map.unseen.margin_px);
  map.edges.resize(num_edges);
  map.neighbors.resize(num_edges);
  for (std::size_t i = 0; i < num_edges; ++i) {
    Fields(archive, map.edges[i]);
    Fields(archive, map.neighbors[i].previous);
    Fields(archive, map.neighbors[i].next);
  }
}

template <typename Archive>
void Fields(Archive& archive, std::vector<EdgeMap>& edge_maps) {
  List(archive, edge_maps);
}

template <typename Archive>
void Fields(Archive& archive, EdgeSketch& sketch) {
  SketchCounts& counts = sketch.counts;
  archive(counts.view_pairs,
          counts.h1_edges,
          counts.hypotheses,
          counts.unsupported,
          counts.rivals,
          counts.used_edges,
          counts.repeated_views,
          sketch.edge_sigma_px);
  List(archive, sketch.edges);
}

template <typename Archive>
void Fields(Archive& archive, ErrorsOfViews& errors) {
  archive(errors.mean_px, errors.median_px);
}

template <typename Archive>
void Fields(Archive& archive, std::string& text) {
  std::vector<char> chars(text.begin(), text.end());
  List(archive, chars);
  if constexpr (Archive::kReads) text.assign(chars.begin(), chars.end());
}

template <typename Archive>
void Fields(Archive& archive, BundleAdjustment& adjustment) {
  List(archive, adjustment.cam_from_world);
  List(archive, adjustment.positions);
  Fields(archive, adjustment.program_version);
}

template <typename Archive>
void Fields(Archive& archive, CurvePoses& poses) {
  List(archive, poses.cam_from_world);
  List(archive, poses.cameras);
  auto accepted = static_cast<std::uint8_t>(poses.accepted);
  archive(accepted);
  if constexpr (Archive::kReads) poses.accepted = accepted != 0;
  Fields(archive, poses.reason);
  archive(poses.num_samples,
          poses.num_check_samples,
          poses.num_check_observations,
          poses.num_points,
          poses.num_check_points,
          poses.num_views_moved,
          poses.max_shift_view_idx);
  for (ErrorsOfViews* errors : {&poses.before,
                                &poses.after,
                                &poses.points_before,
                                &poses.points_after}) {
    Fields(archive, *errors);
  }
  archive(poses.significance, poses.median_shift_px, poses.max_shift_px);
}

namespace {

using EdgeMaps = std::vector<EdgeMap>;

StageKind KindOf(const EdgeMaps&) { return StageKind::kEdgeMaps; }
StageKind KindOf(const EdgeSketch&) { return StageKind::kEdgeSketch; }
StageKind KindOf(const CurvePoses&) { return StageKind::kCurvePoses; }
StageKind KindOf(const BundleAdjustment&) {
  return StageKind::kBundleAdjustment;
}

template <typename T>
bool IsSound(const T&) {
  return true;
}
bool IsSound(const CurvePoses& poses) {
  return poses.max_shift_view_idx < poses.cam_from_world.size();
}

template <typename T>
std::size_t BytesToReserve(const T&) {
  return 0;
}
std::size_t BytesToReserve(const EdgeMaps& edge_maps) {
  std::size_t num_bytes = sizeof(std::uint64_t);
  for (const EdgeMap& map : edge_maps) {
    num_bytes += MinBytes<EdgeMap>() + map.unseen.cells.size() +
                 LinkedEdgeBytes() * map.edges.size();
  }
  return num_bytes;
}

}  // namespace

template <typename T>
Status WriteStageResult(const fs::path& path,
                        std::uint64_t key,
                        const T& result) {
  StageWriter out;
  out.Reserve(BytesToReserve(result));
  Fields(out, const_cast<T&>(result));
  return WriteStage(path, KindOf(result), key, out.bytes());
}

template <typename T>
Result<T> ReadStageResult(const fs::path& path, std::uint64_t key) {
  T result;
  CURVIX_ASSIGN_OR_RETURN(const std::string content,
                          ReadStage(path, KindOf(result), key));
  StageReader in(content);
  Fields(in, result);
  if (!in.AtEnd() || !IsSound(result)) return BrokenStage(path);
  return result;
}

template Status WriteStageResult(const fs::path&,
                                 std::uint64_t,
                                 const EdgeMaps&);
template Status WriteStageResult(const fs::path&,
                                 std::uint64_t,
                                 const EdgeSketch&);
template Status WriteStageResult(const fs::path&,
                                 std::uint64_t,
                                 const CurvePoses&);
template Status WriteStageResult(const fs::path&,
                                 std::uint64_t,
                                 const BundleAdjustment&);
template Result<EdgeMaps> ReadStageResult(const fs::path&, std::uint64_t);
template Result<EdgeSketch> ReadStageResult(const fs::path&, std::uint64_t);
template Result<CurvePoses> ReadStageResult(const fs::path&, std::uint64_t);
template Result<BundleAdjustment> ReadStageResult(const fs::path&,
                                                  std::uint64_t);

namespace {

// Whether what follows is what the head says.
bool HasContent(std::istream& in, const StageHead& head) {
  constexpr std::size_t kChunk = 1 << 20;
  std::uint64_t num_bytes = 0;
  std::uint64_t hash = HashBytes("");
  while (in) {
    const std::string bytes = ReadUpTo(in, kChunk);
    num_bytes += bytes.size();
    hash = HashBytes(bytes, hash);
  }
  in.clear();
  return num_bytes == head.num_bytes && hash == head.checksum;
}

}  // namespace

// Found by List(), so in the namespace of what they describe.
template <typename Archive>
void Fields(Archive& archive, CurveSample& sample) {
  EdgeFields(archive, sample);
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) {
      archive(sample.covariance(row, column));
    }
  }
  auto kind = static_cast<std::uint8_t>(sample.kind);
  archive(kind, sample.kind_probability);
  if constexpr (Archive::kReads) {
    sample.covariance =
        Eigen::Matrix3d(sample.covariance.selfadjointView<Eigen::Upper>());
    sample.kind =
        static_cast<CurveKind>(std::min<int>(kind, kNumCurveKinds - 1));
  }
}

template <typename Archive>
void Fields(Archive& archive, TracedCurve& traced) {
  auto closed = static_cast<std::uint8_t>(traced.curve.closed);
  archive(closed);
  if constexpr (Archive::kReads) traced.curve.closed = closed != 0;
  List(archive, traced.curve.samples);
  List(archive, traced.edges);
}

Status WritePartResult(const fs::path& path,
                       std::uint64_t key,
                       const PartResult& part) {
  ByteWriter head;
  head.Put(part.num_own_edges_2d);
  head.Put(part.num_core_edges_3d);
  head.PutCount(part.curves.size());
  StageWriter curves;
  for (const TracedCurve& curve : part.curves) {
    const std::size_t begin = curves.bytes().size();
    Fields(curves, const_cast<TracedCurve&>(curve));
    head.PutCount(curves.bytes().size() - begin);
  }
  return WriteStage(path,
                    StageKind::kPartResult,
                    key,
                    head.bytes() + std::move(curves).bytes());
}

Result<PartFile> PartFile::Open(const fs::path& path, std::uint64_t key) {
  PartFile file(path);
  file.stream_.open(path, std::ios::binary);
  if (!file.stream_) {
    return Status::NotFound("Cannot open " + path.string() + ".");
  }
  CURVIX_ASSIGN_OR_RETURN(const StageHead head,
                          ReadStageHead(path,
                                        ReadUpTo(file.stream_, kStageHeadBytes),
                                        StageKind::kPartResult,
                                        key));
  if (!HasContent(file.stream_, head)) return BrokenStage(path);

  constexpr std::size_t kCountsBytes = 24;
  file.stream_.seekg(kStageHeadBytes);
  const std::string counts = ReadUpTo(file.stream_, kCountsBytes);
  ByteReader in(counts);
  file.num_own_edges_2d_ = in.Take<std::int64_t>();
  file.num_core_edges_3d_ = in.Take<std::int64_t>();
  const auto num_curves = in.Take<std::uint64_t>();
  constexpr std::size_t kSizeBytes = 8;
  if (!in.ok() || num_curves > head.num_bytes / kSizeBytes) {
    return BrokenStage(path);
  }
  const std::string sizes = ReadUpTo(file.stream_, kSizeBytes * num_curves);
  in = ByteReader(sizes);
  std::uint64_t offset = kStageHeadBytes + kCountsBytes + sizes.size();
  const std::uint64_t end = kStageHeadBytes + head.num_bytes;
  file.offsets_.push_back(offset);
  for (std::uint64_t i = 0; i < num_curves; ++i) {
    const auto size = in.Take<std::uint64_t>();
    if (offset > end || size > end - offset) return BrokenStage(path);
    file.offsets_.push_back(offset += size);
  }
  if (!in.AtEnd() || offset != end) return BrokenStage(path);
  return file;
}

Result<TracedCurve> PartFile::Read(std::size_t curve_idx) {
  if (!stream_.is_open()) stream_.open(path_, std::ios::binary);
  stream_.clear();
  const std::uint64_t begin = offsets_.at(curve_idx);
  const std::uint64_t end = offsets_.at(curve_idx + 1);
  stream_.seekg(static_cast<std::streamoff>(begin));
  const std::string bytes = ReadUpTo(stream_, end - begin);
  StageReader in(bytes);
  TracedCurve curve;
  Fields(in, curve);
  if (bytes.size() != end - begin || !in.AtEnd()) return BrokenStage(path_);
  return curve;
}

}  // namespace curvix
