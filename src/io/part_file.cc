// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Results of parts to and from files, which after
// their head (stage_file.h) hold the number of 2D edges of the part's own
// views, of 3D edges in its core, and of curves (8 bytes each); the number of
// bytes of each curve (8 bytes each); per curve: closed (1 byte), number of
// samples; per sample the fields of a 3D edge (EdgeFields), its covariance (6
// doubles: the upper triangle, row by row), its kind (1 byte) and the
// probability of that (float); number of 2D edges behind the curve, to which
// its supports refer, these as in stage_io.cc but for neighbours.
#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <utility>

#include "base/file_io.h"
#include "io/stage_file.h"
#include "io/stage_io.h"

namespace curvix {
namespace {

constexpr std::size_t kCurveSampleBytes = kEdge3dBytes + 48 + 5;

namespace fs = std::filesystem;

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
  List(archive, traced.curve.samples, kCurveSampleBytes);
  List(archive, traced.edges, kEdge2dBytes);
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
