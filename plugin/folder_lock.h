// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). One run at a time writes to a folder.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

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

}  // namespace curvix
