// SPDX-License-Identifier: BSD-3-Clause
// A workspace on which a run takes a fraction of a second.
#pragma once

#include <gtest/gtest.h>
#include <filesystem>
#include <string>

#include "colmap/colmap_model_format.h"
#include "plugin/commands/command_synthesize.h"
#include "tests/support/temporary_folder.h"

namespace curvix {

// A block in twelve photographs of 64 x 64 pixels, view_000.png and so on.
class SmallWorkspace {
 public:
  SmallWorkspace() {
    static const TemporaryFolder original;
    static const bool is_made = Make(original.path() / "proj");
    EXPECT_TRUE(is_made);
    std::filesystem::copy(original.path(),
                          folder_.path(),
                          std::filesystem::copy_options::recursive);
    model = *ReadColmapModel(path() / "sparse/0");
    ColmapPoint3D& point = model.points.emplace_back();
    point.track = {{model.images[0].image_id, 0}};
    model.images[0].points2D = {{1, 2, 0}};
  }

  std::filesystem::path path() const { return folder_.path() / "proj"; }
  std::filesystem::path At(const std::string& name) const {
    return path() / name;
  }
  // A place outside the workspace.
  std::filesystem::path Outside(const std::string& name) const {
    return folder_.path() / name;
  }
  void Write(const std::string& name, const std::string& bytes) const {
    std::filesystem::remove(At(name));
    folder_.Write("proj/" + name, bytes);
  }
  void WriteImage(const std::string& bytes) const {
    Write("images/view_000.png", bytes);
  }
  void WriteImages(const std::string& bytes) const {
    for (const ColmapImage& image : model.images) {
      Write("images/" + image.name, bytes);
    }
  }
  // The model as it is now, sound or not.
  void WriteModel() const {
    Write("sparse/0/cameras.bin", FormatCamerasBinary(model.cameras));
    Write("sparse/0/images.bin", FormatImagesBinary(model.images));
    Write("sparse/0/points3D.bin", FormatPointsBinary(model.points));
  }

  ColmapModel model;

 private:
  static bool Make(const std::filesystem::path& path) {
    SyntheticOptions options;
    options.solid = SyntheticSolid::kBlock;
    options.num_views = 12;
    options.width = options.height = 64;
    return Synthesize(options, path).ok();
  }

  TemporaryFolder folder_;
};

}  // namespace curvix
