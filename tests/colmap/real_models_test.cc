// SPDX-License-Identifier: BSD-3-Clause
// Models of real data: their points must project to where they were seen, which
// proves the conventions of poses, pixels and camera models together.
#include <curvix/scene.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "base/median.h"
#include "colmap/colmap_model.h"
#include "tests/support/data_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// All folders below the data that hold a model, sorted.
std::vector<fs::path> ModelFolders() {
  std::vector<fs::path> folders;
  std::error_code error;
  fs::recursive_directory_iterator entry(DataFolder(), error);
  for (; !error && entry != fs::recursive_directory_iterator();
       entry.increment(error)) {
    if (entry->is_directory() && FindColmapFormat(entry->path()).ok()) {
      folders.push_back(entry->path());
    }
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

// The distance of every observed 2D point from its projected 3D point, pixels.
std::vector<double> ReprojectionErrors(const ColmapModel& model) {
  std::map<std::uint32_t, Camera> cameras;
  for (const ColmapCamera& item : model.cameras) {
    cameras[item.camera_id] = item.camera;
  }
  std::map<std::uint64_t, Eigen::Vector3d> points;
  for (const ColmapPoint3D& point : model.points) {
    points[point.point3D_id] = point.position;
  }
  std::vector<double> errors;
  for (const ColmapImage& image : model.images) {
    for (const ColmapPoint2D& seen : image.points2D) {
      const auto point = points.find(seen.point3D_id);
      if (point == points.end()) continue;
      const Eigen::Vector3d x = image.cam_from_world * point->second;
      const Eigen::Vector2d pixel =
          ImageFromIdeal(cameras.at(image.camera_id), x.hnormalized());
      errors.push_back((pixel - Eigen::Vector2d(seen.x, seen.y)).norm());
    }
  }
  return errors;
}

TEST(RealModels, PointsProjectToWhereTheyWereSeen) {
  const std::vector<fs::path> folders = ModelFolders();
  if (folders.empty()) {
    GTEST_SKIP() << "no models below " << DataFolder()
                 << "; set CURVIX_DATA to the folder of test data";
  }
  for (const fs::path& folder : folders) {
    const Result<ColmapModel> model = ReadColmapModel(folder);
    ASSERT_TRUE(model.ok()) << model.status().message();
    EXPECT_GE(model->images.size(), 3u) << folder;
    const std::vector<double> errors = ReprojectionErrors(*model);
    const std::string name = fs::relative(folder, DataFolder()).string();
    std::cout << name << ": " << model->images.size() << " views, "
              << model->points.size() << " points, " << errors.size()
              << " observations";
    if (!errors.empty()) {
      EXPECT_LT(MedianOrNan(errors), 1.5) << folder;
      std::cout << ", median error " << MedianOrNan(errors) << " px";
    }
    std::cout << std::endl;
  }
}

TEST(RealModels, BinaryAndTextOfOneModelAreTheSameScene) {
  const fs::path room = DataFolder() / "photos" / "room";
  if (!fs::exists(room / "sparse_txt")) {
    GTEST_SKIP() << room << " is not there; set CURVIX_DATA to the folder of "
                 << "test data";
  }
  const Result<ColmapModel> binary = ReadColmapModel(room / "sparse" / "0");
  const Result<ColmapModel> text = ReadColmapModel(room / "sparse_txt");
  ASSERT_TRUE(binary.ok()) << binary.status().message();
  ASSERT_TRUE(text.ok()) << text.status().message();
  const Scene a = SceneFromColmapModel(*binary, room / "images");
  const Scene b = SceneFromColmapModel(*text, room / "images");
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  ASSERT_EQ(a.views.size(), b.views.size());
  ASSERT_EQ(a.points.size(), b.points.size());
  constexpr double kSixDigits = 1e-5;  // of this text file
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    EXPECT_EQ(a.views[i].name, b.views[i].name);
    EXPECT_EQ(a.views[i].image_id, b.views[i].image_id);
    EXPECT_EQ(a.views[i].camera_idx, b.views[i].camera_idx);
    const Rigid3 motion =
        a.views[i].cam_from_world * b.views[i].cam_from_world.Inverse();
    EXPECT_LT(motion.rotation.vec().norm(), kSixDigits);
    EXPECT_LT(motion.translation.norm(), 10 * kSixDigits);
  }
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].view_idxs, b.points[i].view_idxs);
    EXPECT_LT((a.points[i].position - b.points[i].position).norm(),
              kSixDigits * (1 + a.points[i].position.norm()));
  }
}

}  // namespace
}  // namespace curvix
