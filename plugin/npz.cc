// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include <zip.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "plugin/npy.h"

namespace curvix {
namespace {

constexpr zip_uint64_t kMaxBytes = 1 << 20;  // a camera matrix takes 256

struct Closer {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Archive = std::unique_ptr<zip_t, Closer>;
using ArchiveFile = std::unique_ptr<zip_file_t, Closer>;

Status Broken(const std::string& name, const std::string& why) {
  return {StatusCode::kDataLoss,
          name + " " + why +
              "; copy or download it again, it must be a .npz file."};
}

Result<Archive> OpenArchive(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    return Status(StatusCode::kNotFound,
                  path.string() + " is not a file; name a .npz file.");
  }
  int code = 0;
  Archive archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (archive != nullptr) return archive;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  return Broken(path.string(), "cannot be opened (" + reason + ")");
}

// The unpacked bytes of an entry; nullopt if it is damaged. Reading on to the
// end is what makes libzip compare the checksum.
std::optional<std::string> ReadEntry(zip_t* archive, const zip_stat_t& stat) {
  const ArchiveFile file(zip_fopen_index(archive, stat.index, 0));
  if (file == nullptr) return std::nullopt;
  std::string bytes(static_cast<std::size_t>(stat.size) + 1, '\0');
  std::size_t size = 0;
  while (size < bytes.size()) {
    const zip_int64_t n =
        zip_fread(file.get(), bytes.data() + size, bytes.size() - size);
    if (n < 0) return std::nullopt;
    if (n == 0) break;
    size += static_cast<std::size_t>(n);
  }
  if (size != stat.size) return std::nullopt;
  bytes.resize(size);
  return bytes;
}

Result<NpyArray> ReadArray(zip_t* archive,
                           const zip_stat_t& stat,
                           const std::string& name) {
  if ((stat.valid & ZIP_STAT_SIZE) == 0 || stat.size > kMaxBytes) {
    return Broken(name, "is larger than a megabyte, too large for a camera");
  }
  const std::optional<std::string> bytes = ReadEntry(archive, stat);
  if (!bytes) return Broken(name, "is damaged");
  return ParseNpy(*bytes, name);
}

}  // namespace

Result<std::map<std::string, NpyArray>> ReadNpz(
    const std::filesystem::path& path,
    const std::function<bool(const std::string& name)>& wanted) {
  Result<Archive> archive = OpenArchive(path);
  if (!archive.ok()) return archive.status();
  std::map<std::string, NpyArray> arrays;
  const zip_int64_t count = zip_get_num_entries(archive->get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    const auto index = static_cast<zip_uint64_t>(i);
    if (zip_stat_index(archive->get(), index, 0, &stat) != 0 ||
        (stat.valid & ZIP_STAT_NAME) == 0) {
      return Broken(path.string(), "is damaged");
    }
    std::string name = stat.name;
    if (!name.ends_with(".npy")) continue;
    name.resize(name.size() - 4);
    if (!wanted(name)) continue;
    Result<NpyArray> array =
        ReadArray(archive->get(), stat, name + " of " + path.string());
    if (!array.ok()) return array.status();
    arrays[name] = std::move(array).value();
  }
  return arrays;
}

}  // namespace curvix
