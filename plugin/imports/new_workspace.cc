// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/new_workspace.h"

#include <algorithm>
#include <system_error>

#include "base/cancelled.h"
#include "base/check.h"
#include "base/file_io.h"
#include "colmap/files.h"
#include "plugin/base/staged_output.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Status CannotWrite(const fs::path& path, const std::error_code& error) {
  return Status::InvalidArgument("Cannot write " + path.string() + " (" +
                                 error.message() + ").");
}

bool AreInPlace(const ColmapModel& model,
                const std::vector<fs::path>& files,
                const fs::path& folder) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::error_code error;
    const fs::path image = ImageFile(folder, model.images[i].name);
    if (!fs::equivalent(files[i], image, error)) {
      return false;
    }
  }
  return !files.empty();
}

// fs::copy_file() calls a full disk an "Input/output error".
Status CopyFile(const fs::path& from, const fs::path& to) {
  const Result<std::string> bytes = ReadFile(from);
  return bytes.ok() ? WriteFileAtomically(to, *bytes) : bytes.status();
}

Status PlaceImage(const fs::path& from, const fs::path& to, CopyPolicy policy) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (error) return CannotWrite(to, error);
  const fs::path original = fs::canonical(from, error);
  if (error) return CannotWrite(to, error);
  switch (policy) {
    case CopyPolicy::kCopy:
      return CopyFile(original, to);
    case CopyPolicy::kSoftLink:
      fs::create_symlink(original, to, error);
      break;
    case CopyPolicy::kHardLink:
      fs::create_hard_link(original, to, error);
      break;
  }
  return error ? CannotWrite(to, error) : Status();
}

Status CheckImageFolder(const fs::path& folder,
                        const std::vector<fs::path>& image_files) {
  const auto lies_in = [&](const fs::path& file) {
    return LiesIn(file, {folder});
  };
  if (std::ranges::none_of(image_files, lies_in)) return CheckUnused(folder);
  return Status::InvalidArgument(
      folder.string() +
      " holds the images themselves; leave them there with "
      "--image_path " +
      folder.string() + ", or name another --workspace_path");
}

}  // namespace

Status CheckUnused(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return {};
  if (fs::is_directory(path, error) && fs::is_empty(path, error)) return {};
  return Status::InvalidArgument(
      path.string() +
      " is there already and would be overwritten; name another "
      "--workspace_path or remove it first.");
}

Status MoveIntoWorkspace(const std::vector<std::string>& names,
                         const fs::path& from,
                         const fs::path& to) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::error_code error;
    fs::rename(from / names[i], to / names[i], error);
    if (!error) continue;
    for (std::size_t j = 0; j < i; ++j) {
      std::error_code ignored;
      fs::rename(to / names[j], from / names[j], ignored);
    }
    return CannotWrite(to / names[i], error);
  }
  return {};
}

Status WriteNewWorkspace(const ColmapModel& model,
                         const std::vector<fs::path>& image_files,
                         CopyPolicy policy,
                         const fs::path& workspace,
                         const std::function<bool()>& keep_going) {
  CURVIX_CHECK(image_files.size() == model.images.size(), "one per image");
  CURVIX_RETURN_IF_ERROR(CheckUnused(workspace / "sparse"));
  const bool in_place = AreInPlace(model, image_files, workspace / "images");
  if (!in_place) {
    CURVIX_RETURN_IF_ERROR(CheckImageFolder(workspace / "images", image_files));
  }
  CURVIX_ASSIGN_OR_RETURN(const StagedOutput staged,
                          StagedOutput::Create(workspace, "--workspace_path"));
  const fs::path folder = staged.folder();
  for (std::size_t i = 0; !in_place && i < image_files.size(); ++i) {
    const fs::path to = folder / "images" / model.images[i].name;
    CURVIX_RETURN_IF_ERROR(PlaceImage(image_files[i], to, policy));
    if (keep_going && !keep_going()) return CancelledStatus();
  }
  CURVIX_RETURN_IF_ERROR(WriteColmapModel(model, folder / "sparse" / "0"));
  const std::vector<std::string> names =
      in_place ? std::vector<std::string>{"sparse"}
               : std::vector<std::string>{"images", "sparse"};
  return MoveIntoWorkspace(names, folder, workspace);
}

}  // namespace curvix
