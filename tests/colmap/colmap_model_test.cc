// SPDX-License-Identifier: BSD-3-Clause
#include "colmap/colmap_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/colmap/random_model.h"
#include "tests/support/colmap_text.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// As .bin and as .txt.
constexpr Status (*kWriters[])(const ColmapModel&,
                               const std::filesystem::path&) = {
    WriteColmapModel, WriteTextModel};

void ExpectEqualCameras(const ColmapModel& a, const ColmapModel& b) {
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_EQ(a.cameras[i].camera_id, b.cameras[i].camera_id);
    EXPECT_EQ(a.cameras[i].camera.model, b.cameras[i].camera.model);
    EXPECT_EQ(a.cameras[i].camera.width, b.cameras[i].camera.width);
    EXPECT_EQ(a.cameras[i].camera.height, b.cameras[i].camera.height);
    EXPECT_EQ(a.cameras[i].camera.params, b.cameras[i].camera.params);
  }
}

void ExpectEqualImages(const ColmapModel& a, const ColmapModel& b) {
  ASSERT_EQ(a.images.size(), b.images.size());
  for (std::size_t i = 0; i < a.images.size(); ++i) {
    const ColmapImage& x = a.images[i];
    const ColmapImage& y = b.images[i];
    EXPECT_EQ(x.image_id, y.image_id);
    EXPECT_EQ(x.camera_id, y.camera_id);
    EXPECT_EQ(x.name, y.name);
    EXPECT_LT((x.cam_from_world.rotation.coeffs() -
               y.cam_from_world.rotation.coeffs())
                  .norm(),
              1e-15);
    EXPECT_EQ(x.cam_from_world.translation, y.cam_from_world.translation);
    ASSERT_EQ(x.points2D.size(), y.points2D.size());
    for (std::size_t k = 0; k < x.points2D.size(); ++k) {
      EXPECT_EQ(x.points2D[k].x, y.points2D[k].x);
      EXPECT_EQ(x.points2D[k].y, y.points2D[k].y);
      EXPECT_EQ(x.points2D[k].point3D_id, y.points2D[k].point3D_id);
    }
  }
}

void ExpectEqualPoints(const ColmapModel& a, const ColmapModel& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const ColmapPoint3D& x = a.points[i];
    const ColmapPoint3D& y = b.points[i];
    EXPECT_EQ(x.point3D_id, y.point3D_id);
    EXPECT_EQ(x.position, y.position);
    EXPECT_EQ(x.rgb, y.rgb);
    EXPECT_EQ(x.error, y.error);
    ASSERT_EQ(x.track.size(), y.track.size());
    for (std::size_t k = 0; k < x.track.size(); ++k) {
      EXPECT_EQ(x.track[k].image_id, y.track[k].image_id);
      EXPECT_EQ(x.track[k].point2D_idx, y.track[k].point2D_idx);
    }
  }
}

TEST(ColmapModel, ComesBackAsItWasWritten) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const ColmapModel model = RandomModel(seed);
    for (const auto write : kWriters) {
      const TemporaryFolder folder;
      const auto path = folder.path() / "new" / "0";
      const Status status = write(model, path);
      ASSERT_TRUE(status.ok()) << status.message();
      const Result<ColmapModel> back = ReadColmapModel(path);
      ASSERT_TRUE(back.ok()) << back.status().message();
      ExpectEqualCameras(model, *back);
      ExpectEqualImages(model, *back);
      ExpectEqualPoints(model, *back);
    }
  }
}

TEST(ColmapModel, ComesBackSortedByIdWithUnitQuaternions) {
  ColmapModel model = RandomModel(1);
  std::reverse(model.cameras.begin(), model.cameras.end());
  std::reverse(model.images.begin(), model.images.end());
  std::reverse(model.points.begin(), model.points.end());
  const TemporaryFolder folder;
  const std::string quaternion = "7 2 0 0 0 1 2 3 1 a.png\n\n";
  folder.Write("cameras.txt", "1 SIMPLE_PINHOLE 9 9 5 4 4\n");
  folder.Write("images.txt", quaternion);
  const Result<ColmapModel> scaled = ReadColmapModel(folder.path());
  ASSERT_TRUE(scaled.ok()) << scaled.status().message();
  EXPECT_EQ(scaled->images[0].cam_from_world.rotation.w(), 1);
  EXPECT_TRUE(scaled->points.empty());

  const auto path = folder.path() / "reversed";
  ASSERT_TRUE(WriteColmapModel(model, path).ok());
  const Result<ColmapModel> back = ReadColmapModel(path);
  ASSERT_TRUE(back.ok());
  ExpectEqualCameras(RandomModel(1), *back);
  ExpectEqualImages(RandomModel(1), *back);
  ExpectEqualPoints(RandomModel(1), *back);
}

TEST(ColmapModel, ModelsWithoutPointsAreModels) {
  ColmapModel model = RandomModel(4);
  model.points.clear();
  for (const auto write : kWriters) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write(model, folder.path()).ok());
    const std::string points =
        write == WriteColmapModel ? "points3D.bin" : "points3D.txt";
    EXPECT_TRUE(ReadColmapModel(folder.path()).ok());
    folder.Write(points, "");
    EXPECT_EQ(ReadColmapModel(folder.path()).ok(), write != WriteColmapModel)
        << "a .bin has at least a count";
    std::filesystem::remove(folder.path() / points);
    const Result<ColmapModel> back = ReadColmapModel(folder.path());
    ASSERT_TRUE(back.ok()) << back.status().message();
    EXPECT_TRUE(back->points.empty());
    EXPECT_EQ(back->images.size(), model.images.size());
  }
}

TEST(ColmapModel, CompleteTriplesComeFirstThenBinary) {
  const TemporaryFolder folder;
  EXPECT_EQ(FindColmapFormat(folder.path()).status().code(),
            StatusCode::kNotFound);
  folder.Write("cameras.bin", "");
  folder.Write("images.txt", "");
  EXPECT_FALSE(FindColmapFormat(folder.path()).ok());
  folder.Write("cameras.txt", "");
  EXPECT_EQ(*FindColmapFormat(folder.path()), ColmapFormat::kText);
  folder.Write("images.bin", "");
  EXPECT_EQ(*FindColmapFormat(folder.path()), ColmapFormat::kBinary);
  folder.Write("points3D.txt", "");
  EXPECT_EQ(*FindColmapFormat(folder.path()), ColmapFormat::kText);
  folder.Write("points3D.bin", "");
  EXPECT_EQ(*FindColmapFormat(folder.path()), ColmapFormat::kBinary);
}

TEST(ColmapModel, SceneHasViewsByNameAndPointsWithTheirViews) {
  ColmapModel model;
  model.cameras = {{8, {CameraModel::kPinhole, 9, 9, {5, 5, 4, 4}}},
                   {3, {CameraModel::kSimplePinhole, 8, 8, {5, 4, 4}}}};
  model.images.resize(3);
  model.images[0] = {10, {}, 3, "b.png", {}};
  model.images[1] = {20, {}, 8, "a/z.png", {}};
  model.images[2] = {5, {}, 8, "c.png", {}};
  model.images[2].cam_from_world.translation = {1, 2, 3};
  model.points = {{1, {1, 1, 1}, {}, 0, {{5, 0}, {20, 0}, {5, 3}, {99, 0}}},
                  {2, {2, 2, 2}, {}, 0, {{99, 0}}},
                  {3, {3, 3, 3}, {}, 0, {{10, 0}}}};
  const Scene scene = SceneFromColmapModel(model, "/photos");
  ASSERT_EQ(scene.views.size(), 3u);
  EXPECT_EQ(scene.views[0].name, "a/z.png");
  EXPECT_EQ(scene.views[0].image_path, "/photos/a/z.png");
  EXPECT_EQ(scene.views[0].image_id, 20u);
  EXPECT_EQ(scene.views[0].camera_idx, 0);
  EXPECT_EQ(scene.views[1].camera_idx, 1);
  EXPECT_EQ(scene.views[2].cam_from_world.translation,
            Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scene.cameras[1].width, 8);
  ASSERT_EQ(scene.points.size(), 2u);
  EXPECT_THAT(scene.points[0].view_idxs, ElementsAre(0, 2));
  EXPECT_THAT(scene.points[1].view_idxs, ElementsAre(1));
  EXPECT_EQ(scene.points[0].point3D_id, 1u);
  EXPECT_EQ(scene.points[1].point3D_id, 3u);

  const Scene without = SceneFromColmapModel(model, "/photos", {"b.png"});
  ASSERT_EQ(without.views.size(), 2u);
  ASSERT_EQ(without.points.size(), 1u);
  EXPECT_THAT(without.points[0].view_idxs, ElementsAre(0, 1));
}

TEST(ColmapModel, ValidationSaysWhatIsBroken) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const struct {
    std::function<void(ColmapModel&)> damage;
    std::string sentence;
  } cases[] = {
      {[](auto& m) { m.cameras[1].camera_id = 1; },
       "two cameras have the id 1"},
      {[](auto& m) { m.cameras[0].camera.params[0] = 0; }, "focal length"},
      {[](auto& m) { m.cameras[0].camera.width = 0; }, "0 x 480"},
      {[](auto& m) { m.images[1].image_id = 2; }, "two images have the id 2"},
      {[](auto& m) { m.images[1].name = m.images[0].name; },
       "two images have the name"},
      {[](auto& m) { m.images[3].camera_id = 2; },
       "was taken by camera 2, which the model does not have"},
      {[&](auto& m) { m.images[0].cam_from_world.translation.x() = nan; },
       "image 2 (view 100.jpg) has a translation"},
      {[&](auto& m) { m.images[0].cam_from_world.rotation.x() = inf; },
       "has a rotation"},
      {[](auto& m) { m.images[0].name = ""; }, "empty, absolute"},
      {[](auto& m) { m.images[0].name = "/etc/passwd"; }, "absolute"},
      {[](auto& m) { m.images[0].name = "C:\\a.jpg"; }, "absolute"},
      {[](auto& m) { m.images[0].name = "C:/a.jpg"; }, "absolute"},
      {[](auto& m) { m.images[0].name = "../a.jpg"; }, "\"..\""},
      {[](auto& m) { m.images[0].name = "a/../../b.jpg"; }, "\"..\""},
      {[](auto& m) { m.images[0].name = "a\\..\\b.jpg"; }, "\"..\""},
      {[](auto& m) { m.images[0].name = "a/.."; }, "\"..\""},
      {[](auto& m) { m.points[1].point3D_id = 0; }, "two points have the id 0"},
      {[&](auto& m) { m.points[5].position.z() = nan; }, "position"},
  };
  for (const auto& [damage, sentence] : cases) {
    ColmapModel model = RandomModel(1);
    EXPECT_TRUE(ValidateColmapModel(model).ok());
    damage(model);
    const Status status = ValidateColmapModel(model);
    EXPECT_EQ(status.code(), StatusCode::kDataLoss) << sentence;
    EXPECT_THAT(status.message(), HasSubstr(sentence));
    const TemporaryFolder folder;
    EXPECT_FALSE(WriteColmapModel(model, folder.path()).ok());
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
  for (const char* name :
       {"a..b/...jpg", "c:d.png", "c:d/e.png", "12:30.png"}) {
    ColmapModel model = RandomModel(1);
    model.images[0].name = name;
    EXPECT_TRUE(ValidateColmapModel(model).ok()) << name;
  }
}

TEST(ColmapModel, BrokenCamerasWithoutImagesAreLeftOut) {
  const TemporaryFolder folder;
  folder.Write("cameras.txt",
               "1 SIMPLE_PINHOLE 9 9 5 4 4\n"
               "2 SIMPLE_PINHOLE 9 9 0 4 4\n"
               "3 SIMPLE_PINHOLE 9 9 5 4 4\n"
               "4 FISHEYE9 9 9 5 4 4 1 2\n");
  folder.Write("images.txt", "7 1 0 0 0 1 2 3 1 a.png\n\n");
  const Result<ColmapModel> model = ReadColmapModel(folder.path());
  ASSERT_TRUE(model.ok()) << model.status().message();
  ASSERT_EQ(model->cameras.size(), 2u);
  EXPECT_EQ(model->cameras[0].camera_id, 1u);
  EXPECT_EQ(model->cameras[1].camera_id, 3u);
  folder.Write("images.txt", "7 1 0 0 0 1 2 3 2 a.png\n\n");
  EXPECT_THAT(ReadColmapModel(folder.path()).status().message(),
              HasSubstr("camera 2 is not usable"));
  folder.Write("images.txt", "7 1 0 0 0 1 2 3 4 a.png\n\n");
  EXPECT_THAT(ReadColmapModel(folder.path()).status().message(),
              HasSubstr("camera 4 has the camera model FISHEYE9"));
}

TEST(ColmapModel, IsNotWrittenWhereOtherFilesWouldShadowIt) {
  const ColmapModel model = RandomModel(1);
  for (const std::string name : {"rigs.bin", "frames.txt", "cameras.txt"}) {
    const TemporaryFolder folder;
    folder.Write(name, "x");
    const Status status = WriteColmapModel(model, folder.path());
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_THAT(status.message(), HasSubstr(name));
  }
  const TemporaryFolder folder;
  EXPECT_TRUE(WriteColmapModel(model, folder.path()).ok());
  EXPECT_TRUE(WriteColmapModel(model, folder.path()).ok());
}

TEST(ColmapModel, NamesKeepTheirSpacesAndLineBreaks) {
  for (const std::string name : {" a.jpg", "a.jpg ", "a\nb.jpg"}) {
    ColmapModel model = RandomModel(1);
    model.images[0].name = name;
    const TemporaryFolder folder;
    ASSERT_TRUE(WriteColmapModel(model, folder.path()).ok());
    EXPECT_EQ(ReadColmapModel(folder.path())->images[0].name, name);
  }
}

}  // namespace
}  // namespace curvix
