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
  CURVIX_ASSIGN_OR_RETURN(const Workspace workspace, FindWorkspace(paths));
  CURVIX_ASSIGN_OR_RETURN(WorkspaceScene loaded, LoadWorkspaceScene(workspace));
  if (notes != nullptr) {
    *notes = workspace.notes;
    notes->insert(notes->end(), loaded.notes.begin(), loaded.notes.end());
  }
  return std::move(loaded.scene);
}

}  // namespace curvix
