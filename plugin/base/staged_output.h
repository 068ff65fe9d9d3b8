// SPDX-License-Identifier: BSD-3-Clause
// All files of a run appear together, or none
// does; one run at a time writes to a folder.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace curvix {

// A lock on a folder, without a file in it. It goes with its object, and with
// the process however that ends; children do not inherit it.
class FolderLock {
 public:
  // nullopt: another process, or another object of this one, holds the lock. On
  // a file system that knows no locks, every lock is granted.
  static std::optional<FolderLock> Take(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept
      : file_(std::exchange(other.file_, -1)) {}
  FolderLock& operator=(FolderLock&& other) = delete;
  ~FolderLock();

 private:
  explicit FolderLock(int file) : file_(file) {}

  int file_;  // -1: none
};

// A temporary folder inside the output folder, for its owner alone. Files are
// written there and moved into place by Publish(); without it the destructor
// leaves everything as it was, created folders included. While the object
// lives, no other can be made for the same output folder.
//
// A process that is killed leaves its temporary folder behind. The next
// Create() removes it, or finishes moving the files if Publish() had begun.
class StagedOutput {
 public:
  // kNotFound if the output folder cannot be made or written to,
  // kInvalidArgument if another run is writing to it. `flag`: what the message
  // says to choose another folder with.
  static Result<StagedOutput> Create(const std::filesystem::path& output_path,
                                     const std::string& flag = "--output_path");

  StagedOutput(StagedOutput&& other) noexcept;
  StagedOutput& operator=(StagedOutput&& other) = delete;
  ~StagedOutput();

  // Where the files will be; absolute.
  const std::filesystem::path& output_path() const { return output_path_; }

  // Where to write, under the final file names.
  const std::filesystem::path& folder() const { return folder_; }

  // Moves every file and folder into the output folder, in place of older ones
  // of the same name and of the `obsolete` ones, which go. If one cannot be
  // moved, the older ones come back.
  Status Publish(const std::vector<std::filesystem::path>& obsolete = {});

 private:
  StagedOutput(std::filesystem::path output_path,
               std::filesystem::path first_created,
               FolderLock lock);

  Status MakeFolder(const std::string& flag);

  std::filesystem::path output_path_;
  std::filesystem::path folder_;         // empty: none, or moved from
  std::filesystem::path first_created_;  // empty: the output folder was there
  FolderLock lock_;
};

}  // namespace curvix
