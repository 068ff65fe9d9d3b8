// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Whole files, written so that a reader never meets
// half of one.
#pragma once

#include <curvix/status.h>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <istream>
#include <memory>
#include <string>
#include <string_view>

namespace curvix {

// Takes the bytes of a file, piece by piece.
using ByteSink = std::function<void(std::string_view bytes)>;

// Writes to a temporary file of its own in the same folder, `path` with
// ".<process id>-<number>.tmp" appended, and in the end renames that to `path`,
// so that `path` holds either its old content or all of the new one, also when
// the disk is full, the program is killed or several write to `path` at once:
// then the last that finishes stays. After a failure, or without Finish(), the
// temporary file is removed and `path` stays as it was. The folder must exist.
class FileWriter {
 public:
  explicit FileWriter(std::filesystem::path path);
  // Removes the temporary files that killed programs left beside `path`. A
  // program that still writes one fails in Finish().
  static void RemoveLeftovers(const std::filesystem::path& path);
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;
  ~FileWriter();

  // Finish() tells if it failed.
  void Append(std::string_view bytes);
  ByteSink Sink() {
    return [this](std::string_view bytes) { Append(bytes); };
  }

  // Once, at last. With the system's reason: kNotFound if the file cannot be
  // created, kDataLoss if it cannot be written.
  Status Finish();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::unique_ptr<std::FILE, Closer> file_;  // nullptr: not to be written to
  Status status_;
};

// A file of these bytes, by FileWriter.
Status WriteFileAtomically(const std::filesystem::path& path,
                           std::string_view bytes);

// In lower case: ".obj" of a/B.OBJ.
std::string ExtensionOf(const std::filesystem::path& path);

// The same status with the file that it is about, as a sentence.
Status InFile(const std::filesystem::path& path, const Status& status);

// Up to so many of the bytes that come next.
std::string ReadUpTo(std::istream& stream, std::size_t num_bytes);

// All bytes of `path`. kNotFound if it is not a file that can be opened,
// kDataLoss if it cannot be read to its end.
Result<std::string> ReadFile(const std::filesystem::path& path);

}  // namespace curvix
