// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/npy.h"

#include <zip.h>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "base/bytes.h"
#include "base/count_text.h"
#include "colmap/files.h"

namespace curvix {
namespace {

Status BrokenNpy(const std::string& name, const std::string& why) {
  return Status::DataLoss(name + " " + why +
                          "; save it again with numpy.save or numpy.savez.");
}

// What the header says, a Python dictionary:
// {'descr': '<f8', 'fortran_order': False, 'shape': (4, 4), }
struct Header {
  std::string descr;
  bool fortran_order = false;
  std::string shape;
};

// The text behind 'key': in a Python dictionary; empty if there is none.
std::string_view Behind(std::string_view header, const std::string& key) {
  const std::size_t at = header.find("'" + key + "'");
  if (at == header.npos) return {};
  header.remove_prefix(at + key.size() + 2);
  const std::size_t begin = header.find_first_not_of(" :");
  return begin == header.npos ? std::string_view() : header.substr(begin);
}

std::optional<Header> ParseHeader(std::string_view text) {
  Header header;
  const std::string_view descr = Behind(text, "descr");
  if (descr.empty()) return std::nullopt;
  // A list ("[('x', '<f8')]") describes records; kept, to be refused by type.
  const std::size_t quote = descr.find('\'', 1);
  header.descr = std::string(descr.starts_with('\'') && quote != descr.npos
                                 ? descr.substr(1, quote - 1)
                                 : "of records");
  const std::string_view order = Behind(text, "fortran_order");
  header.fortran_order = order.starts_with("True");
  if (!header.fortran_order && !order.starts_with("False")) return std::nullopt;
  const std::string_view shape = Behind(text, "shape");
  header.shape = shape.substr(0, shape.find(')'));
  // Python 2 writes "(4L, 4L)".
  std::erase_if(header.shape, [](char c) { return c == ' ' || c == 'L'; });
  return header;
}

// Takes the header off `bytes`; nullopt if they do not begin with one.
std::optional<Header> TakeHeader(std::string_view& bytes) {
  constexpr std::string_view kMagic = "\x93NUMPY";
  if (!bytes.starts_with(kMagic) || bytes.size() < 12) return std::nullopt;
  const char version = bytes[6];
  if (version < 1 || version > 3) return std::nullopt;
  const std::size_t begin = version == 1 ? 10 : 12;
  const std::size_t size =
      version == 1
          ? LoadBytes<std::uint16_t>(bytes.data() + 8, std::endian::little)
          : LoadBytes<std::uint32_t>(bytes.data() + 8, std::endian::little);
  if (size > bytes.size() - begin) return std::nullopt;
  const std::string_view text = bytes.substr(begin, size);
  bytes.remove_prefix(begin + size);
  return ParseHeader(text);
}

constexpr std::size_t kNumValues = 16;

// `bytes` hold kNumValues of T.
template <typename T>
Eigen::Matrix4d ValuesOf(std::string_view bytes, const Header& header) {
  const std::endian order =
      header.descr[0] == '>' ? std::endian::big : std::endian::little;
  Eigen::Matrix4d matrix;  // in Fortran order
  for (std::size_t i = 0; i < kNumValues; ++i) {
    matrix.data()[i] = LoadBytes<T>(bytes.data() + i * sizeof(T), order);
  }
  if (!header.fortran_order) matrix.transposeInPlace();
  return matrix;
}

}  // namespace

Result<Eigen::Matrix4d> ParseNpy(std::string_view bytes,
                                 const std::string& name) {
  const std::optional<Header> header = TakeHeader(bytes);
  if (!header) return BrokenNpy(name, "does not begin like a NumPy array");
  const std::string& type = header->descr;
  const bool is_double = type == "<f8" || type == ">f8";
  if (!is_double && type != "<f4" && type != ">f4") {
    return Status::Unsupported(
        name + " holds values of the type " + type +
        " and must hold float32 or float64; convert it with numpy's astype.");
  }
  if (header->shape != "(4,4" && header->shape != "(4,4,") {
    return BrokenNpy(name, "is not a 4 x 4 matrix");
  }
  if (bytes.size() !=
      kNumValues * (is_double ? sizeof(double) : sizeof(float))) {
    return BrokenNpy(name,
                     "is cut short or damaged: its shape does not fit the " +
                         Plural(bytes.size(), "byte") + " of its values");
  }
  const Eigen::Matrix4d matrix = is_double ? ValuesOf<double>(bytes, *header)
                                           : ValuesOf<float>(bytes, *header);
  if (!matrix.allFinite()) return BrokenNpy(name, "holds NaN or infinity");
  return matrix;
}

namespace {

constexpr zip_uint64_t kMaxBytes = 1 << 20;  // a camera matrix takes 256

struct Closer {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Archive = std::unique_ptr<zip_t, Closer>;
using ArchiveFile = std::unique_ptr<zip_file_t, Closer>;

Status BrokenArchive(const std::string& name, const std::string& why) {
  return Status::DataLoss(
      name + " " + why +
      "; copy or download it again, it must be a .npz file.");
}

Result<Archive> OpenArchive(const std::filesystem::path& path) {
  if (!IsFile(path)) {
    return Status::NotFound(path.string() +
                            " is not a file; name a .npz file.");
  }
  int code = 0;
  Archive archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (archive != nullptr) return archive;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  return BrokenArchive(path.string(), "cannot be opened (" + reason + ")");
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

Result<Eigen::Matrix4d> ReadNpyMatrix(zip_t* archive,
                                      const zip_stat_t& stat,
                                      const std::string& name) {
  if ((stat.valid & ZIP_STAT_SIZE) == 0 || stat.size > kMaxBytes) {
    return BrokenArchive(name,
                         "is larger than a megabyte, too large for a camera");
  }
  const std::optional<std::string> bytes = ReadEntry(archive, stat);
  if (!bytes) return BrokenArchive(name, "is damaged");
  return ParseNpy(*bytes, name);
}

}  // namespace

Result<std::map<std::string, Eigen::Matrix4d>> ReadNpz(
    const std::filesystem::path& path,
    const std::function<bool(const std::string& name)>& wanted) {
  CURVIX_ASSIGN_OR_RETURN(Archive archive, OpenArchive(path));
  std::map<std::string, Eigen::Matrix4d> matrices;
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    const auto index = static_cast<zip_uint64_t>(i);
    if (zip_stat_index(archive.get(), index, 0, &stat) != 0 ||
        (stat.valid & ZIP_STAT_NAME) == 0) {
      return BrokenArchive(path.string(), "is damaged");
    }
    std::string name = stat.name;
    if (!name.ends_with(".npy")) continue;
    name.resize(name.size() - 4);
    if (!wanted(name)) continue;
    CURVIX_ASSIGN_OR_RETURN(
        matrices[name],
        ReadNpyMatrix(archive.get(), stat, name + " of " + path.string()));
  }
  return matrices;
}

}  // namespace curvix
