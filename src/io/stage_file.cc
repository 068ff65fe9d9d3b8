// SPDX-License-Identifier: BSD-3-Clause
#include "io/stage_file.h"

#include "base/file_io.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// "CVXSTAGE", little endian.
constexpr std::uint64_t kMagic = 0x4547415453585643;
constexpr std::uint32_t kVersion = 11;

Status Other(const fs::path& path) {
  return Status::NotFound(path.string() +
                          " is the result of another input, of other options " +
                          "or of another program.");
}

}  // namespace

std::uint64_t HashBytes(std::string_view bytes, std::uint64_t hash) {
  for (const char c : bytes) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  return hash;
}

Status BrokenStage(const fs::path& path) {
  return Status::DataLoss(path.string() +
                          " is broken or truncated; remove it.");
}

Status WriteStage(const fs::path& path,
                  StageKind kind,
                  std::uint64_t key,
                  const std::string& content) {
  ByteWriter head;
  head.Put(kMagic);
  head.Put(kVersion);
  head.Put(static_cast<std::uint32_t>(kind));
  head.Put(key);
  head.PutCount(content.size());
  head.Put(HashBytes(content));
  FileWriter out(path);
  out.Append(head.bytes());
  out.Append(content);
  return out.Finish();
}

Result<StageHead> ReadStageHead(const fs::path& path,
                                std::string_view bytes,
                                StageKind kind,
                                std::uint64_t key) {
  ByteReader in(bytes);
  const bool is_stage = in.Take<std::uint64_t>() == kMagic &&
                        in.Take<std::uint32_t>() == kVersion;
  const bool is_kind =
      in.Take<std::uint32_t>() == static_cast<std::uint32_t>(kind);
  const bool is_key = in.Take<std::uint64_t>() == key;
  StageHead head;
  head.num_bytes = in.Take<std::uint64_t>();
  head.checksum = in.Take<std::uint64_t>();
  if (!in.ok()) return BrokenStage(path);
  if (!is_stage || !is_kind || !is_key) return Other(path);
  return head;
}

Result<std::string> ReadStage(const fs::path& path,
                              StageKind kind,
                              std::uint64_t key) {
  CURVIX_ASSIGN_OR_RETURN(std::string bytes, ReadFile(path));
  CURVIX_ASSIGN_OR_RETURN(const StageHead head,
                          ReadStageHead(path, bytes, kind, key));
  bytes.erase(0, kStageHeadBytes);
  if (bytes.size() != head.num_bytes || HashBytes(bytes) != head.checksum) {
    return BrokenStage(path);
  }
  return bytes;
}

}  // namespace curvix
