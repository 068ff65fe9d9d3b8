// SPDX-License-Identifier: BSD-3-Clause
#include "base/file_io.h"

#include <unistd.h>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

namespace curvix {
namespace {

namespace fs = std::filesystem;

// The system's reason for the last failure, e.g. " (No space left on device)".
std::string Reason(int error) {
  if (error == 0) return "";
  return " (" + std::generic_category().message(error) + ")";
}

Status CannotWrite(const fs::path& path, int error) {
  return Status::DataLoss("Cannot write to " + path.string() + Reason(error) +
                          "; check the free space of the disk and its quota.");
}

constexpr std::string_view kTemporaryEnding = ".tmp";

// Of this process.
fs::path TemporaryPath(fs::path path, std::uintptr_t number) {
  path += "." + std::to_string(getpid()) + "-" + std::to_string(number);
  return path += kTemporaryEnding;
}

// Whether TemporaryPath(), of any process, may have named it for `target`.
bool IsTemporaryName(std::string_view name, const std::string& target) {
  return name.starts_with(target + ".") && name.ends_with(kTemporaryEnding);
}

}  // namespace

FileWriter::FileWriter(fs::path path) : path_(std::move(path)) {
  // No other writer of this process has this address.
  auto number = reinterpret_cast<std::uintptr_t>(this);
  do {
    temporary_ = TemporaryPath(path_, number++);
    errno = 0;
    // "x": fails if anything is there, so that no link is followed and no other
    // file touched, as that of a killed process with the same id.
    file_.reset(std::fopen(temporary_.c_str(), "wbx"));
  } while (file_ == nullptr && errno == EEXIST);
  if (file_ == nullptr) {
    status_ =
        Status::NotFound("Cannot create " + path_.string() + Reason(errno) +
                         "; check that the folder exists and may be written.");
  }
}

void FileWriter::RemoveLeftovers(const fs::path& path) {
  const std::string target = path.filename().string();
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code error;
  std::vector<fs::path> leftovers;
  for (fs::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    const fs::path& found = it->path();
    if (IsTemporaryName(found.filename().string(), target)) {
      leftovers.push_back(found);
    }
  }
  for (const fs::path& leftover : leftovers) fs::remove(leftover, error);
}

FileWriter::~FileWriter() {
  if (file_ == nullptr) return;
  file_.reset();
  std::error_code error;
  fs::remove(temporary_, error);
}

void FileWriter::Append(std::string_view bytes) {
  if (!status_.ok()) return;
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
    status_ = CannotWrite(path_, errno);
  }
}

Status FileWriter::Finish() {
  if (file_ == nullptr) return status_;
  errno = 0;
  // Closing fails when the last bytes do not fit.
  if (std::fclose(file_.release()) != 0 && status_.ok()) {
    status_ = CannotWrite(path_, errno);
  }
  std::error_code error;
  if (status_.ok()) {
    fs::rename(temporary_, path_, error);
    if (!error) return {};
    status_ = Status::DataLoss(
        "Cannot replace " + path_.string() + " (" + error.message() +
        "); check that it is not a folder and may be replaced.");
  }
  fs::remove(temporary_, error);
  return status_;
}

Status WriteFileAtomically(const fs::path& path, std::string_view bytes) {
  FileWriter file(path);
  file.Append(bytes);
  return file.Finish();
}

std::string ExtensionOf(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

Status InFile(const std::filesystem::path& path, const Status& status) {
  return {status.code(), path.string() + ": " + status.message() + "."};
}

std::string ReadUpTo(std::istream& stream, std::size_t num_bytes) {
  std::string bytes(num_bytes, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(num_bytes));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

Result<std::string> ReadFile(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    const bool is_folder = fs::is_directory(path, error);
    return Status::NotFound(
        is_folder ? path.string() + " is a folder; name a file."
                  : "There is no file " + path.string() + "; check the path.");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    return Status::NotFound("Cannot open " + path.string() + Reason(errno) +
                            "; check that it may be read.");
  }
  // Iterators would throw where read() tells of an error.
  constexpr std::size_t kBlock = 1 << 16;
  std::string bytes;
  while (stream) bytes += ReadUpTo(stream, kBlock);
  if (stream.bad()) {
    return Status::DataLoss("Cannot read " + path.string() + " to its end" +
                            Reason(errno) + "; check the disk.");
  }
  return bytes;
}

}  // namespace curvix
