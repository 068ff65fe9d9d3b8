// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include <curvix/colmap_io.h>
#include <utility>

#include "colmap/workspace.h"

namespace curvix {

Result<Scene> ReadColmapScene(const std::filesystem::path& workspace_path,
                              const std::filesystem::path& image_path) {
  WorkspacePaths paths;
  paths.workspace_path = workspace_path;
  paths.image_path = image_path;
  const Result<Workspace> workspace = FindWorkspace(paths);
  if (!workspace.ok()) return workspace.status();
  Result<WorkspaceScene> loaded = LoadWorkspaceScene(*workspace);
  if (!loaded.ok()) return loaded.status();
  return std::move(loaded->scene);
}

}  // namespace curvix
