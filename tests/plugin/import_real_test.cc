// SPDX-License-Identifier: BSD-3-Clause
// Real data sets, imported, against COLMAP models of the same photographs:
// triangulated points must project to where they were seen.
#include <curvix/scene.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>

#include "plugin/imports/importers.h"
#include "tests/support/data_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

ImportOptions From(const std::string& input_path,
                   const std::string& image_path = "") {
  ImportOptions options;
  options.input_path = DataFolder() / input_path;
  if (!image_path.empty()) options.image_path = DataFolder() / image_path;
  return options;
}

// The median distance, in pixels, of the 2D points of `given` from their 3D
// points, projected with the cameras of `model`.
double MedianError(const ColmapModel& given, const ColmapModel& model) {
  std::map<std::uint32_t, Camera> cameras;
  for (const ColmapCamera& item : model.cameras) {
    cameras[item.camera_id] = item.camera;
  }
  std::map<std::string, const ColmapImage*> images;
  for (const ColmapImage& image : model.images) images[image.name] = &image;
  std::map<std::uint64_t, Eigen::Vector3d> points;
  for (const ColmapPoint3D& point : given.points) {
    points[point.point3D_id] = point.position;
  }
  std::vector<double> errors;
  for (const ColmapImage& image : given.images) {
    const ColmapImage& other = *images.at(image.name);
    const Camera& camera = cameras.at(other.camera_id);
    for (const ColmapPoint2D& seen : image.points2D) {
      const auto point = points.find(seen.point3D_id);
      if (point == points.end()) continue;
      const Eigen::Vector3d x = other.cam_from_world * point->second;
      const Eigen::Vector2d pixel = ImageFromIdeal(camera, x.hnormalized());
      errors.push_back((pixel - Eigen::Vector2d(seen.x, seen.y)).norm());
    }
  }
  const auto middle =
      errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

void ExpectPointsWhereTheyWereSeen(const Result<ImportedScene>& scene,
                                   const fs::path& model_path) {
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const Result<ColmapModel> given = ReadColmapModel(model_path);
  ASSERT_TRUE(given.ok()) << given.status().message();
  EXPECT_EQ(scene->model.images.size(), given->images.size());
  EXPECT_EQ(scene->model.cameras.size(), 1u);
  const double error = MedianError(*given, scene->model);
  const double given_error = MedianError(*given, *given);
  std::cout << "median error " << error << " px, of the given model "
            << given_error << " px" << std::endl;
  EXPECT_LT(error, 0.7);
  EXPECT_NEAR(error, given_error, 1e-3);
}

TEST(ImportReal, DinoRingSeesItsPoints) {
  if (!fs::exists(DataFolder() / "dino_ring")) {
    GTEST_SKIP() << "no dino_ring in " << DataFolder() << "; set CURVIX_DATA";
  }
  ExpectPointsWhereTheyWereSeen(ImportMiddlebury(From("dino_ring")),
                                DataFolder() / "dino_ring/sparse/0");
}

TEST(ImportReal, DtuSeesItsPoints) {
  if (!fs::exists(DataFolder() / "dtu_scan24")) {
    GTEST_SKIP() << "no dtu_scan24 in " << DataFolder() << "; set CURVIX_DATA";
  }
  ExpectPointsWhereTheyWereSeen(
      ImportDtu(From("dtu_scan24/cameras_sphere.npz")),
      DataFolder() / "dtu_scan24/sparse/0");
}

TEST(ImportReal, AbcNefIsItsConvertedModel) {
  for (const std::string name : {"abc_nef/00000006", "abc_nef/00000952"}) {
    if (!fs::exists(DataFolder() / name)) {
      GTEST_SKIP() << "no " << name << " in " << DataFolder()
                   << "; set CURVIX_DATA";
    }
    const auto scene = ImportNerf(From(name, name + "/images"));
    ASSERT_TRUE(scene.ok()) << scene.status().message();
    const auto given = ReadColmapModel(DataFolder() / name / "sparse/0");
    ASSERT_TRUE(given.ok()) << given.status().message();
    ASSERT_EQ(scene->model.images.size(), given->images.size());
    EXPECT_EQ(scene->model.cameras.size(), 1u);
    std::map<std::string, Rigid3> poses;
    for (const ColmapImage& image : given->images) {
      poses[image.name] = image.cam_from_world;
    }
    double largest = 0;
    for (const ColmapImage& image : scene->model.images) {
      const Rigid3 motion =
          image.cam_from_world * poses.at(image.name).Inverse();
      largest = std::max(
          {largest, motion.rotation.vec().norm(), motion.translation.norm()});
    }
    std::cout << name << ": largest difference " << largest << std::endl;
    EXPECT_LT(largest, 1e-6);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(scene->model.cameras[0].camera.params[i],
                  given->cameras[0].camera.params[i],
                  1e-6);
    }
  }
}

TEST(ImportReal, TextModelAndItsImagesComeTogether) {
  const std::string room = "photos/room";
  if (!fs::exists(DataFolder() / room / "sparse_txt")) {
    GTEST_SKIP() << "no " << room << " in " << DataFolder()
                 << "; set CURVIX_DATA";
  }
  const auto scene =
      ImportColmapImages(From(room + "/sparse_txt", room + "/images"));
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_FALSE(scene->model.points.empty());
  EXPECT_LT(MedianError(scene->model, scene->model), 1.5);
}

}  // namespace
}  // namespace curvix
