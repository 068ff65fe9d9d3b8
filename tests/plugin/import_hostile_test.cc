// SPDX-License-Identifier: BSD-3-Clause
// Broken and hostile data sets: one sentence each, and nothing imported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "plugin/imports/importers.h"
#include "tests/plugin/import_fixtures.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Importer = Result<ImportedScene> (*)(const ImportOptions& options);

class HostileImport : public testing::Test {
 protected:
  HostileImport() {
    for (const char* name : {"a.png", "b.png", "image/0.png", "image/1.png"}) {
      folder_.Write(name, PngOfSize(640, 480));
    }
  }

  // The failure of `importer` on the file `name` with `text`: one line.
  Status Failure(Importer importer,
                 const std::string& name,
                 const std::string& text) {
    ImportOptions options;
    options.input_path = folder_.Write(name, text);
    const Result<ImportedScene> scene = importer(options);
    EXPECT_FALSE(scene.ok()) << text;
    EXPECT_THAT(scene.status().message(), AllOf(Not(""), Not(HasSubstr("\n"))))
        << text;
    return scene.status();
  }
  // ... on an archive.
  Status NpzFailure(const std::map<std::string, std::string>& entries) {
    ImportOptions options;
    options.input_path = folder_.path() / "cameras.npz";
    WriteNpz(options.input_path, entries);
    const Result<ImportedScene> scene = ImportDtu(options);
    EXPECT_FALSE(scene.ok());
    return scene.status();
  }

  TemporaryFolder folder_;
};

std::string ParLine(const std::string& name) {
  return name + " " + MatrixText(TestCalibration()) +
         MatrixText(Eigen::Matrix3d::Identity()) + "0 0 5\n";
}

TEST_F(HostileImport, MiddleburySaysWhatIsWrong) {
  const auto message = [&](const std::string& text) {
    return Failure(ImportMiddlebury, "x_par.txt", text).message();
  };
  EXPECT_THAT(message(""), HasSubstr("number of images"));
  EXPECT_THAT(message("two\n"), HasSubstr("number of images"));
  EXPECT_THAT(message("2\n" + ParLine("a.png")),
              HasSubstr("announces 2 images, and there is 1"));
  EXPECT_THAT(message("1\na.png 1 2 3\n"), HasSubstr("21 numbers"));
  EXPECT_THAT(message("1\n" + ParLine("../a.png")), HasSubstr("../a.png"));
  EXPECT_THAT(message("1\n" + ParLine("/etc/passwd")), HasSubstr("relative"));
  EXPECT_THAT(message("1\n" + ParLine("c.png")), HasSubstr("c.png"));
  EXPECT_THAT(message("2\n" + ParLine("a.png") + ParLine("a.png")),
              HasSubstr("two images"));
  std::string nan = ParLine("a.png");
  nan.replace(nan.find("700"), 3, "nan");
  EXPECT_THAT(message("1\n" + nan), HasSubstr("finite"));
  std::string mirrored = ParLine("a.png");
  mirrored.replace(mirrored.rfind("1 0 0 5"), 1, "-1");
  EXPECT_THAT(message("1\n" + mirrored), HasSubstr("rotation"));
  std::string no_place = ParLine("a.png");
  no_place.replace(no_place.size() - 2, 1, "inf");
  EXPECT_THAT(message("1\n" + no_place), HasSubstr("finite"));
  folder_.Write("c.png", "not an image");
  EXPECT_THAT(message("1\n" + ParLine("c.png")), HasSubstr("c.png is broken"));
}

TEST_F(HostileImport, DtuArchivesSayWhatIsWrong) {
  Eigen::MatrixXd good = Eigen::Matrix4d::Identity();
  good.topLeftCorner(3, 3) = TestCalibration();
  EXPECT_THAT(NpzFailure({{"cameras", NpyOfMatrix(good)}}).message(),
              HasSubstr("world_mat_0"));
  Eigen::MatrixXd nan = good;
  nan(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(NpzFailure({{"world_mat_0", NpyOfMatrix(nan)}}).message(),
              AllOf(HasSubstr("world_mat_0"), HasSubstr("NaN")));
  EXPECT_THAT(
      NpzFailure({{"world_mat_0", NpyOfMatrix(good.topRows(3))}}).message(),
      HasSubstr("4 x 4"));
  EXPECT_THAT(
      NpzFailure({{"world_mat_0", NpyFile("'<i8'", "False", "(4, 4)", "")}})
          .message(),
      HasSubstr("<i8"));
  EXPECT_THAT(NpzFailure({{"world_mat_0",
                           NpyFile("'<f8'", "False", "(4, 4)", "12345678")}})
                  .message(),
              HasSubstr("cut short"));
  const std::string zero = NpyOfMatrix(Eigen::Matrix4d::Zero());
  EXPECT_THAT(
      NpzFailure({{"world_mat_0", zero}, {"world_mat_1", zero}}).message(),
      HasSubstr("no projection matrix"));
  EXPECT_EQ(Failure(ImportDtu, "x.npz", "no archive").code(),
            StatusCode::kDataLoss);
}

TEST_F(HostileImport, DtuWithoutImagesAsksForThem) {
  folder_.Write("cal/pos_001.txt", MatrixText(Eigen::MatrixXd::Ones(3, 4)));
  ImportOptions options;
  options.input_path = folder_.path() / "cal";
  EXPECT_THAT(ImportDtu(options).status().message(), HasSubstr("--image_path"));
  folder_.Write("cal/pos_001.txt", "1 2 3");
  EXPECT_THAT(ImportDtu(options).status().message(), HasSubstr("3 x 4"));
  folder_.Write("cal/pos_001.txt", MatrixText(Eigen::MatrixXd::Ones(4, 4)));
  EXPECT_THAT(ImportDtu(options).status().message(), HasSubstr("more than"));
}

// A transforms.json with one frame.
std::string Transforms(const std::string& path,
                       const std::string& matrix,
                       const std::string& camera = "\"fl_x\": 700") {
  return "{" + camera + ", \"frames\": [{\"file_path\": \"" + path +
         "\", \"transform_matrix\": " + matrix + "}]}";
}

TEST_F(HostileImport, NerfSaysWhatIsWrong) {
  const std::string unit = MatrixJson(Eigen::Matrix4d::Identity());
  const auto message = [&](const std::string& text) {
    return Failure(ImportNerf, "t.json", text).message();
  };
  for (const char* text : {"",
                           "[",
                           "[]",
                           "{}",
                           "{\"frames\": 3}",
                           "{\"frames\": [3]}",
                           "{\"frames\": [{\"file_path\": 3}]}",
                           "{\"frames\": []}"}) {
    message(text);
  }
  message(std::string(100000, '['));
  EXPECT_THAT(message(Transforms("a.png", "[[NaN]]")), HasSubstr("JSON"));
  EXPECT_THAT(message(Transforms("a.png", "[[1e999]]")), HasSubstr("JSON"));
  EXPECT_THAT(message(Transforms("a.png", "[[1, 2], 3]")),
              HasSubstr("4 x 4 matrix"));
  EXPECT_THAT(message(Transforms("a.png", MatrixJson(Eigen::Matrix4d::Zero()))),
              HasSubstr("0 0 0 1"));
  EXPECT_THAT(
      message(Transforms("a.png", MatrixJson(Eigen::MatrixXd::Zero(3, 4)))),
      HasSubstr("no rotation"));
  EXPECT_THAT(message(Transforms("../a.png", unit)), HasSubstr("../a.png"));
  EXPECT_THAT(message(Transforms("..\\\\a.png", unit)),
              HasSubstr("with --image_path"));
  EXPECT_THAT(message(Transforms("a.png\\u0000", unit)),
              HasSubstr("control characters"));
  EXPECT_THAT(message(Transforms("c.png", unit)), HasSubstr("c.png"));
  const auto camera = [&](const std::string& fields) {
    return message(Transforms("a", unit, fields));
  };
  EXPECT_THAT(camera("\"x\": 1"), HasSubstr("camera_angle_x"));
  EXPECT_THAT(camera("\"fl_x\": \"700\""), HasSubstr("not a number"));
  EXPECT_THAT(camera("\"fl_x\": -700"), HasSubstr("frame 1 (a.png)"));
  EXPECT_THAT(camera("\"fl_x\": 700, \"w\": 320"), HasSubstr("640 x 480"));
  EXPECT_THAT(camera("\"fl_x\": 700, \"camera_model\": \"EQUIRECTANGULAR\""),
              HasSubstr("EQUIRECTANGULAR"));
  EXPECT_THAT(camera("\"fl_x\": 700, \"latlong\": true"), HasSubstr("latlong"));
  EXPECT_THAT(camera("\"fl_x\": 700, \"is_fisheye\": 1"),
              HasSubstr("true or false"));
  EXPECT_THAT(camera("\"fl_x\": 700, \"is_fisheye\": true, \"p1\": 0.1"),
              HasSubstr("p1 and p2"));
  EXPECT_THAT(camera("\"fl_x\": 700, \"distortion_params\": [0.1]"),
              HasSubstr("distortion_params"));
  EXPECT_THAT(camera("\"camera_angle_x\": 45"), HasSubstr("in radians"));
  EXPECT_THAT(camera("\"camera_intrinsics\": [[1, 2], [3, 4]]"),
              HasSubstr("3 x 3"));
}

}  // namespace
}  // namespace curvix
