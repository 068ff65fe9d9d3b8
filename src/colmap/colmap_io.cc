// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include <curvix/colmap_io.h>
#include <utility>

#include "colmap/workspace.h"

namespace curvix {

Result<Scene> ReadColmapScene(const std::filesystem::path& workspace_path,
                              const std::filesystem::path& image_path,
                              std::vector<std::string>* notes) {
  WorkspacePaths paths;
  paths.workspace_path = workspace_path;
  paths.image_path = image_path;
  const Result<Workspace> workspace = FindWorkspace(paths);
  if (!workspace.ok()) return workspace.status();
  Result<WorkspaceScene> loaded = LoadWorkspaceScene(*workspace);
  if (!loaded.ok()) return loaded.status();
  if (notes != nullptr) {
    *notes = workspace->notes;
    notes->insert(notes->end(), loaded->notes.begin(), loaded->notes.end());
  }
  return std::move(loaded->scene);
}

}  // namespace curvix
