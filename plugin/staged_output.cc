// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/staged_output.h"

#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

namespace curvix {
namespace {

namespace fs = std::filesystem;

// The topmost folder of `path` that does not exist; empty if all do.
fs::path FirstMissing(const fs::path& path) {
  std::error_code ignored;
  fs::path missing;
  for (fs::path at = path; !at.empty() && !fs::exists(at, ignored);
       at = at.parent_path()) {
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

Status CannotWrite(const fs::path& path, const std::string& reason) {
  return {StatusCode::kInvalidArgument,
          "cannot write to " + path.string() + " (" + reason +
              "); choose another folder with --output_path"};
}

std::vector<fs::path> EntryNames(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
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
    if (!fs::exists(from / name, error)) continue;
    fs::rename(from / name, to / name, error);
    if (error) return error;
    moved.push_back(name);
  }
  return {};
}

}  // namespace

Result<StagedOutput> StagedOutput::Create(const fs::path& output_path) {
  const fs::path output = fs::absolute(output_path).lexically_normal();
  const fs::path first_created = FirstMissing(output);
  std::error_code error;
  fs::create_directories(output, error);
  std::string folder = (output / ".unfinished-XXXXXX").string();
  if (!error && mkdtemp(folder.data()) == nullptr) {
    error = std::error_code(errno, std::generic_category());
  }
  if (error) {
    RemoveEmptyFolders(output, first_created);
    return CannotWrite(output, error.message());
  }
  return StagedOutput(output, folder, first_created);
}

StagedOutput::StagedOutput(fs::path output_path,
                           fs::path folder,
                           fs::path first_created)
    : output_path_(std::move(output_path)),
      folder_(std::move(folder)),
      first_created_(std::move(first_created)) {}

StagedOutput::StagedOutput(StagedOutput&& other) noexcept
    : output_path_(std::move(other.output_path_)),
      folder_(std::exchange(other.folder_, {})),
      first_created_(std::exchange(other.first_created_, {})) {}

StagedOutput::~StagedOutput() {
  if (folder_.empty()) return;
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  RemoveEmptyFolders(output_path_, first_created_);
}

Status StagedOutput::Publish(const std::vector<fs::path>& obsolete) {
  const std::vector<fs::path> names = EntryNames(folder_);
  std::vector<fs::path> replaced = names;
  replaced.insert(replaced.end(), obsolete.begin(), obsolete.end());
  const fs::path older = folder_ / "older";
  std::error_code error;
  fs::create_directory(older, error);
  if (error) return CannotWrite(output_path_, error.message());
  std::vector<fs::path> saved;
  std::vector<fs::path> published;
  error = MoveEntries(replaced, output_path_, older, saved);
  if (!error) error = MoveEntries(names, folder_, output_path_, published);
  if (!error) return {};
  std::vector<fs::path> undone;
  MoveEntries(published, output_path_, folder_, undone);
  MoveEntries(saved, older, output_path_, undone);
  return CannotWrite(output_path_, error.message());
}

}  // namespace curvix
