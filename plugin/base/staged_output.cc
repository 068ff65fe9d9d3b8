// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/staged_output.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <unistd.h>
#include <cerrno>
#include <system_error>

#include "colmap/files.h"

namespace curvix {

std::optional<FolderLock> FolderLock::Take(
    const std::filesystem::path& folder) {
  FolderLock lock(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock.file_ >= 0 && flock(lock.file_, LOCK_EX | LOCK_NB) != 0 &&
      errno == EWOULDBLOCK) {
    return std::nullopt;
  }
  return lock;
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

namespace {

namespace fs = std::filesystem;

bool IsThere(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

// The topmost folder of `path` that does not exist; empty if all do.
fs::path FirstMissing(const fs::path& path) {
  fs::path missing;
  for (fs::path at = path; !at.empty() && !IsThere(at); at = at.parent_path()) {
    missing = at;
  }
  return missing;
}

// Removes `path` and the empty folders above it up to `first_created`.
void RemoveEmptyFolders(fs::path path, const fs::path& first_created) {
  std::error_code error;
  for (; !first_created.empty() && !error; path = path.parent_path()) {
    fs::remove(path, error);
    if (path == first_created) return;
  }
}

Status CannotWrite(const fs::path& path,
                   const std::string& reason,
                   const std::string& flag = "--output_path") {
  return Status::NotFound("Cannot write to " + path.string() + " (" + reason +
                          "); choose another folder with " + flag);
}

// In a temporary folder: what was replaced, and the names of what is to go.
// The first is made when all files are written and Publish() begins.
constexpr const char* kOlder = ".older";
constexpr const char* kObsolete = ".obsolete";
constexpr const char* kUnfinished = ".unfinished-";

std::vector<fs::path> EntryNames(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const fs::path& entry : EntriesOf(folder)) {
    const fs::path name = entry.filename();
    if (name != kOlder && name != kObsolete) names.push_back(name);
  }
  return names;
}

// Moves the named files and folders that are there; those moved so far are
// added to `moved`.
std::error_code MoveEntries(const std::vector<fs::path>& names,
                            const fs::path& from,
                            const fs::path& to,
                            std::vector<fs::path>& moved) {
  std::error_code error;
  for (const fs::path& name : names) {
    if (!IsThere(from / name)) continue;
    fs::rename(from / name, to / name, error);
    if (error) return error;
    moved.push_back(name);
  }
  return {};
}

// Keeps the entry `name` of `output` in `older`. A file stays where it is, too,
// until something takes its place.
std::error_code Keep(const fs::path& name,
                     const fs::path& output,
                     const fs::path& older) {
  std::error_code error;
  fs::create_hard_link(output / name, older / name, error);
  if (error) fs::rename(output / name, older / name, error);
  return error;
}

// Moves what is in `folder`, in which kOlder is, into `output`. May be called
// again after a process was killed in it.
Status MoveIntoPlace(const fs::path& folder, const fs::path& output) {
  const fs::path older = folder / kOlder;
  std::vector<fs::path> kept;
  std::vector<fs::path> published;
  std::error_code error =
      MoveEntries(EntryNames(folder / kObsolete), output, older, kept);
  if (!error) fs::remove_all(folder / kObsolete, error);
  for (const fs::path& name : EntryNames(folder)) {
    if (!error && IsThere(output / name)) {
      error = Keep(name, output, older);
      if (!error) kept.push_back(name);
    }
    if (!error) fs::rename(folder / name, output / name, error);
    if (error) break;
    published.push_back(name);
  }
  if (!error) return {};
  std::vector<fs::path> undone;
  MoveEntries(published, output, folder, undone);
  MoveEntries(kept, older, output, undone);
  return CannotWrite(output, error.message());
}

// Brings what killed processes left in `output` to its end. A link is not
// ours.
Status FinishOlderRuns(const fs::path& output, const std::string& flag) {
  for (const fs::path& name : EntryNames(output)) {
    const fs::path folder = output / name;
    std::error_code error;
    if (!name.string().starts_with(kUnfinished) ||
        !fs::is_directory(fs::symlink_status(folder, error))) {
      continue;
    }
    if (IsThere(folder / kOlder)) {
      CURVIX_RETURN_IF_ERROR(MoveIntoPlace(folder, output));
    }
    fs::remove_all(folder, error);
    if (error) return CannotWrite(output, error.message(), flag);
  }
  return {};
}

}  // namespace

Result<StagedOutput> StagedOutput::Create(const fs::path& output_path,
                                          const std::string& flag) {
  const fs::path output = fs::absolute(output_path).lexically_normal();
  const fs::path first_created = FirstMissing(output);
  std::error_code error;
  fs::create_directories(output, error);
  if (error) {
    RemoveEmptyFolders(output, first_created);
    return CannotWrite(output, error.message(), flag);
  }
  std::optional<FolderLock> lock = FolderLock::Take(output);
  if (!lock) {
    return Status::InvalidArgument(
        "Another run is writing to " + output.string() +
        "; wait for its end, or choose another folder with " + flag);
  }
  StagedOutput staged(output, first_created, *std::move(lock));
  CURVIX_RETURN_IF_ERROR(FinishOlderRuns(output, flag));
  CURVIX_RETURN_IF_ERROR(staged.MakeFolder(flag));
  return staged;
}

StagedOutput::StagedOutput(fs::path output_path,
                           fs::path first_created,
                           FolderLock lock)
    : output_path_(std::move(output_path)),
      first_created_(std::move(first_created)),
      lock_(std::move(lock)) {}

StagedOutput::StagedOutput(StagedOutput&& other) noexcept
    : output_path_(std::move(other.output_path_)),
      folder_(std::exchange(other.folder_, {})),
      first_created_(std::exchange(other.first_created_, {})),
      lock_(std::move(other.lock_)) {}

StagedOutput::~StagedOutput() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
  RemoveEmptyFolders(output_path_, first_created_);
}

Status StagedOutput::MakeFolder(const std::string& flag) {
  std::string folder =
      (output_path_ / (std::string(kUnfinished) + "XXXXXX")).string();
  if (mkdtemp(folder.data()) == nullptr) {
    return CannotWrite(
        output_path_, std::generic_category().message(errno), flag);
  }
  folder_ = folder;
  return {};
}

Status StagedOutput::Publish(const std::vector<fs::path>& obsolete) {
  std::error_code error;
  for (const fs::path& name : obsolete) {
    if (IsThere(folder_ / name)) continue;
    fs::create_directories(folder_ / kObsolete / name, error);
    if (error) return CannotWrite(output_path_, error.message());
  }
  fs::create_directory(folder_ / kOlder, error);
  if (error) return CannotWrite(output_path_, error.message());
  return MoveIntoPlace(folder_, output_path_);
}

}  // namespace curvix
