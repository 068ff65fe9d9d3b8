// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// Where things are in a COLMAP workspace, and its scene.
//
//   <workspace>/images/                 images
//   <workspace>/sparse/<k>/  sparse/    models           -> curvix/<k>/ curvix/
//   <workspace>/dense/<k>/              a workspace of its own, undistorted:
//                                       images/, sparse/ -> curvix/
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <filesystem>
#include <string>
#include <vector>

#include "colmap/colmap_model.h"

namespace curvix {

// The paths of the command line; an empty one is not given.
struct WorkspacePaths {
  std::filesystem::path workspace_path;  // must be given
  std::filesystem::path input_path;      // the folder of the model, or models
  std::filesystem::path image_path;      // the folder of the images
  std::filesystem::path output_path;     // the folder of the results
  std::filesystem::path mask_path;       // the folder of the masks
};

struct Workspace {
  std::filesystem::path model_path;
  std::filesystem::path image_path;
  std::filesystem::path output_path;  // may not exist yet
  std::filesystem::path mask_path;    // absolute; "": there are no masks
  std::vector<std::string> notes;     // sentences worth telling the user
};

// Finds the folders; `paths` wins over what is found. Folders named by numbers
// count in numerical order.
//  * Model: input_path, if it holds one, else its folders <k>; if it is not
//    given, the first of <workspace>/sparse/<k>, <workspace>/sparse,
//    <workspace>/dense/<k>/sparse, <workspace> that holds one. Of several <k>
//    the one with most images, with a note that says so. Ties: the smallest k.
//  * Images: the first that exists of <workspace>/images, images/ beside the
//    model's sparse/, and the image_path in the model's project.ini, which is
//    relative to the current folder or, failing that, to the workspace. A model
//    of a dense/<k> does not take <workspace>/images, which are not
//    undistorted.
//  * Results: for a model in the workspace, curvix/<k> beside sparse/<k> and
//    curvix beside sparse. Else <workspace>/curvix if the workspace is the
//    model, and <workspace>/curvix/<name of the model's folder> if it is not.
//  * Masks: only those of `paths`.
// Folders and images may be links. Files of a model without input_path lie, all
// links followed, in its folder or in the workspace. kInvalidArgument if the
// workspace is not given; kNotFound for model files that lead out, and, with
// the places that were tried, if a folder is not there.
Result<Workspace> FindWorkspace(const WorkspacePaths& paths);

// The same without images and masks, which need not be there.
Result<Workspace> FindModelAndResults(const WorkspacePaths& paths);

// To be asked before anything is written to `found`, the workspace of `paths`:
// kInvalidArgument if the folder of the results was not given and it, or the
// curvix/ that it is in, is a link.
Status CheckOutputLinks(const WorkspacePaths& paths, const Workspace& found);

// The same of a folder of results that was not given.
Status CheckNoLink(const std::filesystem::path& output_path);

struct WorkspaceScene {
  ColmapModel model;                        // all of it
  Scene scene;                              // the views whose images are there
  std::vector<std::string> missing_images;  // names, sorted
  bool is_scaled = false;  // cameras are scaled, see ScaleToImages()
  std::vector<std::string> notes;
};

// Reads the model and leaves out the views whose images are not on disk, with a
// note that names the first five. Cameras are scaled to images of another size
// (scale_to_images.h), with a note. Another note counts the views without a
// mask, if the workspace has masks. Fails if the model cannot be read or if
// fewer than three views remain.
Result<WorkspaceScene> LoadWorkspaceScene(const Workspace& workspace);

// The scene of a valid model in the folders of the workspace, without the
// images whose names are in `left_out` (sorted). The mask of images/a/b.jpg is,
// as for COLMAP, a/b.jpg.png in the folder of masks; b.png will do for b.png.
Scene MakeScene(const Workspace& workspace,
                const ColmapModel& model,
                const std::vector<std::string>& left_out);

}  // namespace curvix
