// SPDX-License-Identifier: BSD-3-Clause
// What the importers of data sets have in common. Each reads cameras, finds the
// images and gives a COLMAP model; none writes anything.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "colmap/colmap_model.h"
#include "edge_detection/load_image.h"
#include "plugin/imports/projection_matrix.h"

namespace curvix {

struct ImportOptions {
  std::filesystem::path input_path;  // the cameras: a file or its folder
  std::filesystem::path image_path;  // the images; empty: looked for
  // The coordinate that the source gives to the centre of the first pixel;
  // nullopt: what its format says.
  std::optional<double> first_pixel;
  // DTU: take only images whose names hold this text.
  std::string image_filter;
  // DTU .npz: world unit and origin of scale_mat instead of world_mat.
  bool normalize = false;
};

struct ImportedScene {
  ColmapModel model;
  std::vector<std::filesystem::path> image_files;  // of model.images, in order
  std::vector<std::string> notes;  // sentences worth telling the user
};

// One image with its camera, pixels and axes in COLMAP's conventions.
struct ImportedView {
  std::string name;            // for the model
  std::filesystem::path file;  // where it is
  Camera camera;
  Rigid3 cam_from_world;
};

// An image with what a calibration says of it.
struct CalibratedImage {
  std::string name;
  CalibratedPose pose;
  std::string source;  // what errors call it
};

// The views as a model: ids from 1 in the order of `views`, one camera for all
// views whose cameras are the same number for number. kDataLoss, calling the
// source `source`, if there are no views, or if a name, a camera or a pose
// cannot be used.
Result<ImportedScene> SceneOfViews(const std::vector<ImportedView>& views,
                                   const std::filesystem::path& source);

// The same of images in `folder`, whose poses count the centre of the first
// pixel as (first_pixel, first_pixel). Errors, too, of ReadImageSize and
// CameraFromCalibration.
Result<ImportedScene> SceneOfImages(const std::vector<CalibratedImage>& images,
                                    const std::filesystem::path& folder,
                                    double first_pixel,
                                    const std::filesystem::path& source);

// kDataLoss if the name of an image may lead out of its folder, or holds
// control characters, which a model cannot keep.
Status CheckImageName(const std::string& name,
                      const std::filesystem::path& source);

// kNotFound, naming up to five of them, unless all `names` are files in
// `folder`, as ImageFile() finds them.
Status CheckImagesExist(const std::vector<std::string>& names,
                        const std::filesystem::path& folder);

// `image_path` if it is given, else the first of `places` that holds `name`,
// else the first of them. kNotFound if `image_path` is not a folder.
Result<std::filesystem::path> FindImageFolder(
    const std::filesystem::path& image_path,
    const std::vector<std::filesystem::path>& places,
    const std::string& name);

// The names of the files in `folder`, sorted. None if there is no such folder.
std::vector<std::string> FileNames(const std::filesystem::path& folder);

// The names of the files in `folder` whose extensions are those of images and
// that hold `filter`, sorted. None if there is no such folder.
std::vector<std::string> ImageNames(const std::filesystem::path& folder,
                                    const std::string& filter);

// The only file in `folder` whose name begins with `prefix` and ends with
// `suffix`. kNotFound: none or several; the sentence names those.
Result<std::filesystem::path> OnlyFile(const std::filesystem::path& folder,
                                       const std::string& prefix,
                                       const std::string& suffix);

}  // namespace curvix
