// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Whole files.
#include <curvix/file_io.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>

namespace curvix {
namespace {

namespace fs = std::filesystem;

// The system's reason for the last failure, e.g. " (No space left on device)".
std::string Reason(int error) {
  if (error == 0) return "";
  return " (" + std::generic_category().message(error) + ")";
}

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

Status WriteNewFile(const fs::path& path, std::string_view bytes) {
  errno = 0;
  // "x": fails if anything is there, so that no link is followed.
  std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "wbx"));
  if (file == nullptr) {
    return {StatusCode::kInvalidArgument,
            "Cannot create " + path.string() + Reason(errno) +
                "; check that the folder exists and may be written."};
  }
  const std::size_t num_written =
      std::fwrite(bytes.data(), 1, bytes.size(), file.get());
  // Closing fails when the last bytes do not fit.
  if (std::fclose(file.release()) != 0 || num_written != bytes.size()) {
    return {StatusCode::kInvalidArgument,
            "Cannot write " + std::to_string(bytes.size()) + " bytes to " +
                path.string() + Reason(errno) +
                "; check the free space of the disk and its quota."};
  }
  return {};
}

}  // namespace

Status WriteFileAtomically(const fs::path& path, std::string_view bytes) {
  fs::path temporary = path;
  temporary += ".tmp";
  std::error_code error;
  fs::remove(temporary, error);  // of a program that was killed
  Status status = WriteNewFile(temporary, bytes);
  if (status.ok()) {
    fs::rename(temporary, path, error);
    if (!error) return {};
    status = {StatusCode::kInvalidArgument,
              "Cannot rename " + temporary.string() + " to " + path.string() +
                  " (" + error.message() + "); check that the target is not " +
                  "a folder and may be replaced."};
  }
  fs::remove(temporary, error);
  return status;
}

Result<std::string> ReadFile(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    return Status(StatusCode::kNotFound,
                  "There is no file " + path.string() + "; check the path.");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    return Status(StatusCode::kNotFound,
                  "Cannot open " + path.string() + Reason(errno) +
                      "; check that it may be read.");
  }
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) {
    return Status(StatusCode::kDataLoss,
                  "Cannot read " + path.string() + " to its end" +
                      Reason(errno) + "; check the disk.");
  }
  return bytes;
}

}  // namespace curvix
