// SPDX-License-Identifier: BSD-3-Clause
// Known cameras, written in each format, come back as they were.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_io.h"
#include "plugin/imports/importers.h"
#include "tests/plugin/import_fixtures.h"
#include "tests/support/colmap_text.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kNumViews = 5;

class Import : public testing::Test {
 protected:
  Import() {
    std::mt19937 random(7);
    for (int i = 0; i < kNumViews; ++i) poses_.push_back(RandomPose(random));
  }

  fs::path Photo(const std::string& name, int width = 640, int height = 480) {
    return folder_.Write(name, PngOfSize(width, height));
  }
  ImportOptions From(const std::string& input_path) {
    ImportOptions options;
    options.input_path = folder_.path() / input_path;
    return options;
  }
  void ExpectPoses(const Result<ImportedScene>& scene, double tolerance) {
    ASSERT_TRUE(scene.ok()) << scene.status().message();
    ASSERT_EQ(scene->model.images.size(), poses_.size());
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const Rigid3 motion =
          scene->model.images[i].cam_from_world * poses_[i].Inverse();
      EXPECT_LT(motion.rotation.vec().norm(), tolerance);
      EXPECT_LT(motion.translation.norm(), tolerance);
      EXPECT_TRUE(fs::exists(scene->image_files[i]));
    }
  }
  // The only camera: f = (700, 710) and this principal point.
  void ExpectCamera(const ImportedScene& scene, double cx, double cy) {
    ASSERT_THAT(scene.model.cameras, SizeIs(1));
    const Camera& camera = scene.model.cameras[0].camera;
    EXPECT_EQ(camera.model, CameraModel::kPinhole);
    EXPECT_EQ(camera.width, 640);
    EXPECT_EQ(camera.height, 480);
    EXPECT_THAT(camera.params,
                ElementsAre(DoubleNear(700, 1e-6),
                            DoubleNear(710, 1e-6),
                            DoubleNear(cx, 1e-6),
                            DoubleNear(cy, 1e-6)));
  }
  // A transforms.json of a frame a pose; `more` begins the file, `of_frame`
  // each frame.
  void WriteTransforms(const std::string& more,
                       const std::string& of_frame,
                       const std::string& path_start) {
    std::string text = "{" + more + "\"frames\": [";
    for (int i = 0; i < kNumViews; ++i) {
      text += (i > 0 ? ", {" : "{") + of_frame + "\"file_path\": \"" +
              path_start + std::to_string(i) + "\", \"transform_matrix\": " +
              MatrixJson(NerfMatrix(poses_[static_cast<std::size_t>(i)])) + "}";
    }
    folder_.Write("transforms.json", text + "]}");
  }

  TemporaryFolder folder_;
  std::vector<Rigid3> poses_;
};

TEST_F(Import, MiddleburyComesBackWithPixelsFromZero) {
  std::string text = "\xEF\xBB\xBF" + std::to_string(kNumViews) + "\r\n";
  for (int i = 0; i < kNumViews; ++i) {
    const Rigid3& pose = poses_[static_cast<std::size_t>(i)];
    const std::string name = "set" + std::to_string(i) + ".png";
    Photo("images/" + name);
    text += name + " " + MatrixText(TestCalibration()) +
            MatrixText(pose.rotation.toRotationMatrix()) +
            MatrixText(pose.translation) + "\r\n";
  }
  folder_.Write("set_par.txt", text);
  const auto scene = ImportMiddlebury(From(""));
  ExpectPoses(scene, 1e-12);
  ExpectCamera(*scene, 310.5, 245.5);
  EXPECT_EQ(scene->model.images[3].name, "set3.png");
  ImportOptions options = From("set_par.txt");
  options.first_pixel = 0.5;
  options.image_path = folder_.path() / "images";
  ExpectCamera(*ImportMiddlebury(options), 310, 245);
}

TEST_F(Import, DtuArchiveComesBackThroughSinglePrecision) {
  std::map<std::string, std::string> entries;
  for (int i = 0; i < kNumViews; ++i) {
    Photo("image/00" + std::to_string(i) + ".png");
    Eigen::MatrixXd world = Eigen::Matrix4d::Identity();
    world.topRows(3) =
        -2 * TestCalibration() * Matrix34(poses_[static_cast<std::size_t>(i)]);
    std::string values;
    for (Eigen::Index k = 0; k < 16; ++k) {
      AppendLittleEndian(static_cast<float>(world(k / 4, k % 4)), values);
    }
    entries["world_mat_" + std::to_string(i)] =
        NpyFile("'<f4'", "False", "(4, 4)", values);
    entries["camera_mat_" + std::to_string(i)] = "something else";
  }
  WriteNpz(folder_.path() / "cameras_sphere.npz", entries);
  const auto scene = ImportDtu(From(""));
  ExpectPoses(scene, 1e-5);
  ASSERT_THAT(scene->model.cameras, SizeIs(1));
  EXPECT_NEAR(scene->model.cameras[0].camera.params[2], 310.5, 2e-3);
  EXPECT_THAT(scene->notes, IsEmpty());
}

// By name, 10.png comes before 2.png.
TEST_F(Import, DtuArchivesFindImagesOfTheSameNumbers) {
  std::map<std::string, std::string> entries;
  for (const int i : {2, 10}) {
    Photo(std::to_string(i) + ".png");
    Eigen::Matrix4d world =
        Eigen::Vector4d(700, 700, 1, 1).asDiagonal().toDenseMatrix();
    world(2, 3) = i;
    entries["world_mat_" + std::to_string(i)] = NpyOfMatrix(world);
  }
  WriteNpz(folder_.path() / "cameras.npz", entries);
  const auto scene = ImportDtu(From(""));
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  for (const ColmapImage& image : scene->model.images) {
    EXPECT_NEAR(image.cam_from_world.translation.z(),
                image.name == "2.png" ? 2 : 10,
                1e-9);
  }
}

TEST_F(Import, FilesInTheCurrentFolderHaveTheirImagesThere) {
  Photo("000.png");
  WriteNpz(folder_.path() / "cameras.npz",
           {{"world_mat_0",
             NpyOfMatrix(Eigen::Matrix4d(
                 Eigen::Vector4d(700, 700, 1, 1).asDiagonal()))}});
  WriteTransforms("\"fl_x\": 700, ", "", "gone");
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  ImportOptions options;
  options.input_path = "cameras.npz";
  const auto dtu = ImportDtu(options);
  options.input_path = "transforms.json";
  const Status nerf = ImportNerf(options).status();
  fs::current_path(before);
  ASSERT_TRUE(dtu.ok()) << dtu.status().message();
  EXPECT_EQ(dtu->model.images[0].name, "000.png");
  EXPECT_THAT(nerf.message(), HasSubstr("not in . (gone0"));
}

TEST_F(Import, DtuNormalizeMovesTheWorldIntoTheUnitSphere) {
  std::map<std::string, std::string> entries;
  Eigen::Matrix4d world_from_unit = Eigen::Matrix4d::Identity() * 50;
  world_from_unit.col(3) << 1, -2, 3, 1;
  for (int i = 0; i < kNumViews; ++i) {
    Photo("images/" + std::to_string(i) + ".png");
    const auto number = std::to_string(i);
    Eigen::Matrix4d world = Eigen::Matrix4d::Identity();
    world.topRows(3) =
        TestCalibration() * Matrix34(poses_[static_cast<std::size_t>(i)]);
    entries["world_mat_" + number] = NpyOfMatrix(world);
    entries["scale_mat_" + number] = NpyOfMatrix(world_from_unit);
  }
  WriteNpz(folder_.path() / "cameras.npz", entries);
  ImportOptions options = From("cameras.npz");
  ExpectPoses(ImportDtu(options), 1e-9);
  options.normalize = true;
  for (Rigid3& pose : poses_) {  // x_cam / 50 of the same rays
    pose.translation = pose * Eigen::Vector3d(1, -2, 3) / 50;
  }
  const auto scene = ImportDtu(options);
  ExpectPoses(scene, 1e-9);
  ExpectCamera(*scene, 310.5, 245.5);
}

TEST_F(Import, DtuPositionsFindTheirImagesByNumber) {
  for (int i = 0; i < kNumViews; ++i) {
    const std::string number = "00" + std::to_string(i + 1);
    Photo("scan/rect_" + number + "_3_r5000.png");
    Photo("scan/rect_" + number + "_max.png");
    folder_.Write("scan/._rect_" + number + "_max.png", "of macOS");
    const Rigid3& pose = poses_[static_cast<std::size_t>(i)];
    folder_.Write("cal/pos_" + number + ".txt",
                  MatrixText(1e3 * TestCalibration() * Matrix34(pose)));
  }
  folder_.Write("cal/pos_064.txt", MatrixText(Eigen::MatrixXd::Ones(3, 4)));
  ImportOptions options = From("cal");
  options.image_path = folder_.path() / "scan";
  EXPECT_THAT(ImportDtu(options).status().message(),
              HasSubstr("--image_filter"));
  options.image_filter = "max";
  const auto scene = ImportDtu(options);
  ExpectPoses(scene, 1e-9);
  ExpectCamera(*scene, 310.5, 245.5);
  EXPECT_EQ(scene->model.images[4].name, "rect_005_max.png");
  EXPECT_THAT(scene->notes, ElementsAre(HasSubstr("5 have the same number")));
}

TEST_F(Import, BlenderLooksThroughTheMiddleOfTheImage) {
  for (int i = 0; i < kNumViews; ++i) {
    Photo("train/r_" + std::to_string(i) + ".png");
  }
  const double angle = 2 * std::atan(320.0 / 700);
  WriteTransforms("\"camera_angle_x\": " + NumberText(angle) + ", ",
                  "\"rotation\": 0.1, ",
                  "./train/r_");
  const auto scene = ImportNerf(From(""));
  ExpectPoses(scene, 1e-12);
  ASSERT_THAT(scene->model.cameras, SizeIs(1));
  EXPECT_THAT(
      scene->model.cameras[0].camera.params,
      ElementsAre(DoubleNear(700, 1e-9), DoubleNear(700, 1e-9), 320, 240));
  EXPECT_EQ(scene->model.images[2].name, "train/r_2.png");
}

TEST_F(Import, AbcNefIntrinsicsCountFromZeroAndFoldersMayBeElsewhere) {
  for (int i = 0; i < kNumViews; ++i) {
    Photo("photos/" + std::to_string(i) + ".png");
  }
  WriteTransforms(
      "\"camera_angle_x\": 0.5, ",
      "\"camera_intrinsics\": " + MatrixJson(TestCalibration()) + ", ",
      "./train/");
  EXPECT_EQ(ImportNerf(From("")).status().code(), StatusCode::kNotFound);
  ImportOptions options = From("transforms.json");
  options.image_path = folder_.path() / "photos";
  const auto scene = ImportNerf(options);
  ExpectPoses(scene, 1e-12);
  ExpectCamera(*scene, 310.5, 245.5);
  EXPECT_EQ(scene->model.images[2].name, "2.png");
}

TEST_F(Import, InstantNgpKeepsColmapsPixelsAndDistortion) {
  for (int i = 0; i < kNumViews; ++i) Photo(std::to_string(i) + ".png");
  const std::string pinhole =
      "\"fl_x\": 700, \"fl_y\": 710, \"cx\": 310, \"cy\": 245, \"w\": 640, "
      "\"h\": 480.0, \"camera_angle_x\": 0.1, ";
  WriteTransforms(pinhole, "", "");
  const auto scene = ImportNerf(From(""));
  ExpectPoses(scene, 1e-12);
  ExpectCamera(*scene, 310, 245);
  const std::string radial =
      "\"k1\": 0.1, \"k2\": 0.2, \"p1\": 0.3, \"p2\": 0.4, ";
  const std::tuple<std::string, CameraModel, std::vector<double>> kinds[] = {
      {radial, CameraModel::kOpenCV, {0.1, 0.2, 0.3, 0.4}},
      {radial + "\"k3\": 0.5, ",
       CameraModel::kFullOpenCV,
       {0.1, 0.2, 0.3, 0.4, 0.5, 0, 0, 0}},
      {radial + "\"k4\": 0.6, \"camera_model\": \"FULL_OPENCV\", ",
       CameraModel::kFullOpenCV,
       {0.1, 0.2, 0.3, 0.4, 0, 0.6, 0, 0}},
      {"\"distortion_params\": [0.1, 0.2, 0, 0, 0.3, 0.4], \"k1\": 9, ",
       CameraModel::kOpenCV,
       {0.1, 0.2, 0.3, 0.4}},
      {"\"k1\": 0.1, \"k4\": 0.6, \"camera_model\": \"OPENCV_FISHEYE\", ",
       CameraModel::kOpenCVFisheye,
       {0.1, 0, 0, 0.6}}};
  for (auto [fields, model, params] : kinds) {
    WriteTransforms(pinhole + fields, "", "");
    const auto distorted = ImportNerf(From(""));
    ASSERT_TRUE(distorted.ok()) << distorted.status().message();
    const Camera& camera = distorted->model.cameras[0].camera;
    EXPECT_EQ(camera.model, model);
    params.insert(params.begin(), {700, 710, 310, 245});
    EXPECT_EQ(camera.params, params);
  }
}

// A focal length of the frame wins over one of another kind of the file.
TEST_F(Import, FramesMayHaveOtherKindsOfFocalLengths) {
  Photo("0.png");
  Photo("1.png");
  const auto frame = [&](const std::string& fields, std::size_t i) {
    return "{\"file_path\": \"" + std::to_string(i) + ".png\", " + fields +
           ", \"transform_matrix\": " + MatrixJson(NerfMatrix(poses_[i])) + "}";
  };
  folder_.Write("transforms.json",
                "{\"fl_x\": 700, \"fl_y\": 710, // of another camera\n"
                "\"frames\": [" +
                    frame("\"fl_x\": 500", 0) + ", " +
                    frame("\"camera_angle_x\": 1.5707963267948966", 1) + "]}");
  const auto scene = ImportNerf(From(""));
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  ASSERT_THAT(scene->model.cameras, SizeIs(2));
  EXPECT_THAT(scene->model.cameras[0].camera.params,
              ElementsAre(500, 500, 320, 240));
  EXPECT_NEAR(scene->model.cameras[1].camera.params[0], 320, 1e-9);
  EXPECT_NEAR(scene->model.cameras[1].camera.params[1], 320, 1e-9);
}

// Folders of another machine, of which the last tells images apart.
TEST_F(Import, NerfImagesAreFoundWithoutTheirFirstFolders) {
  for (const char* name : {"left/a.png", "right/a.png"}) {
    Photo(std::string("photos/") + name);
  }
  std::string frames;
  for (std::size_t i = 0; i < 2; ++i) {
    frames += (i > 0 ? ", " : "") +
              ("{\"file_path\": \"/home/x/images/" +
               std::string(i > 0 ? "right" : "left") +
               "/a.png\", \"transform_matrix\": ") +
              MatrixJson(NerfMatrix(poses_[i])) + "}";
  }
  folder_.Write("transforms.json",
                "{\"fl_x\": 700, \"frames\": [" + frames + "]}");
  ImportOptions options = From("");
  EXPECT_THAT(ImportNerf(options).status().message(),
              HasSubstr("name their folder with --image_path"));
  options.image_path = folder_.path() / "photos";
  const auto scene = ImportNerf(options);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->model.images[0].name, "left/a.png");
  EXPECT_EQ(scene->model.images[1].name, "right/a.png");
}

TEST_F(Import, FramesMayHaveCamerasOfTheirOwn) {
  Photo("0.png");
  Photo("1.png", 480, 640);
  folder_.Write("transforms.json",
                "{\"fl_x\": 700, \"frames\": [{\"file_path\": \"0.png\", "
                "\"transform_matrix\": " +
                    MatrixJson(NerfMatrix(poses_[0])) +
                    "}, {\"file_path\": \"1\", \"fl_x\": 500, \"cx\": 100, "
                    "\"transform_matrix\": " +
                    MatrixJson(3 * NerfMatrix(poses_[1]).topRows(3)) + "}]}");
  const auto scene = ImportNerf(From(""));
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  ASSERT_THAT(scene->model.cameras, SizeIs(2));
  EXPECT_THAT(scene->model.cameras[0].camera.params,
              ElementsAre(700, 700, 320, 240));
  EXPECT_THAT(scene->model.cameras[1].camera.params,
              ElementsAre(500, 500, 100, 320));
  // A scale of the axes is no scale of the world.
  EXPECT_TRUE(
      scene->model.images[1].cam_from_world.Inverse().translation.isApprox(
          3 * poses_[1].Inverse().translation, 1e-12));
}

TEST_F(Import, ColmapModelMeetsItsImages) {
  ColmapModel model;
  model.cameras.push_back(
      {4, {CameraModel::kSimpleRadial, 640, 480, {700, 320, 240, 0.1}}});
  ColmapImage image;
  image.image_id = 9;
  image.camera_id = 4;
  image.name = "left/a b.png";
  image.cam_from_world = poses_[0];
  image.points2D.push_back({1, 2, 5});
  model.images.push_back(image);
  model.points.push_back({5, {1, 2, 3}, {1, 2, 3}, 0.5, {{9, 0}}});
  const fs::path folder = folder_.path() / "model";
  ASSERT_TRUE(WriteTextModel(model, folder).ok());
  Photo("photos/left/a b.png");
  ImportOptions options = From("model");
  options.image_path = folder_.path() / "photos";
  const auto scene = ImportColmapImages(options);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->model.images[0].image_id, 9u);
  EXPECT_EQ(scene->model.images[0].points2D[0].point3D_id, 5u);
  EXPECT_EQ(scene->model.points[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scene->image_files[0], options.image_path / "left/a b.png");
  // A model made on Windows.
  model.images[0].name = "left\\a b.png";
  ASSERT_TRUE(WriteTextModel(model, folder).ok());
  const auto from_windows = ImportColmapImages(options);
  ASSERT_TRUE(from_windows.ok()) << from_windows.status().message();
  EXPECT_EQ(from_windows->image_files, scene->image_files);
  Photo("photos/left/a b.png", 320, 240);
  EXPECT_THAT(ImportColmapImages(options).status().message(),
              HasSubstr("320 x 240 pixels and its camera 640 x 480"));
}

}  // namespace
}  // namespace curvix
