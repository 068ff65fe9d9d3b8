// SPDX-License-Identifier: BSD-3-Clause
// Broken, hostile and unusual model files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstring>

#include "colmap/colmap_model.h"
#include "colmap/colmap_model_format.h"
#include "tests/colmap/random_model.h"
#include "tests/support/colmap_text.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Bytes of values one after the other.
template <typename... T>
std::string Bytes(T... values) {
  std::string bytes;
  const auto append = [&bytes](const auto& value) {
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof(value));
    std::memcpy(&bytes[end], &value, sizeof(value));
  };
  (append(values), ...);
  return bytes;
}

using U32 = std::uint32_t;
using I32 = std::int32_t;
using U64 = std::uint64_t;

// One camera, one image with two 2D points, one point: laid out by hand.
const std::string kCamera =
    Bytes(U64{1}, U32{7}, I32{2}, U64{640}, U64{480}, 500., 320., 240., 0.1);
const std::string kImage =
    Bytes(U64{1}, U32{9}, 0., 0., 0., 2., 1., 2., 3., U32{7}) +
    std::string("a b.png\0", 8) +
    Bytes(U64{2}, 1.5, 2.5, U64{4}, 3.5, 4.5, ~U64{0});
const std::string kPoint = Bytes(U64{1}, U64{4}, 1., 2., 3.) + "\x01\x02\xFF" +
                           Bytes(0.25, U64{1}, U32{9}, U32{0});

TEST(ColmapBinary, FollowsTheLayoutByteForByte) {
  const CamerasOrError cameras = ParseCamerasBinary(kCamera, "c");
  ASSERT_TRUE(cameras.ok()) << cameras.status().message();
  EXPECT_EQ((*cameras)[0].camera_id, 7u);
  EXPECT_EQ((*cameras)[0].camera.model, CameraModel::kSimpleRadial);
  EXPECT_EQ((*cameras)[0].camera.params[3], 0.1);
  EXPECT_EQ(FormatCamerasBinary(*cameras), kCamera);

  const ImagesOrError images = ParseImagesBinary(kImage, "i");
  ASSERT_TRUE(images.ok()) << images.status().message();
  const ColmapImage& image = (*images)[0];
  EXPECT_EQ(image.name, "a b.png");
  EXPECT_EQ(image.cam_from_world.rotation.z(), 1);
  EXPECT_EQ(image.cam_from_world.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(image.points2D[0].point3D_id, 4u);
  EXPECT_EQ(image.points2D[1].point3D_id, kNoPoint3D);
  std::string normalised = kImage;
  normalised.replace(8 + 4 + 24, 8, Bytes(1.));
  EXPECT_EQ(FormatImagesBinary(*images), normalised);

  const PointsOrError points = ParsePointsBinary(kPoint, "p");
  ASSERT_TRUE(points.ok()) << points.status().message();
  EXPECT_EQ((*points)[0].rgb[2], 255);
  EXPECT_EQ((*points)[0].error, 0.25);
  EXPECT_EQ((*points)[0].track[0].image_id, 9u);
  EXPECT_EQ(FormatPointsBinary(*points), kPoint);
}

TEST(ColmapBinary, EveryTruncationAndEveryExtraByteIsAnError) {
  ColmapModel model = RandomModel(1);
  model.images.resize(5);
  model.points.resize(5);
  const auto expect_lost = [](const auto& parse, const std::string& bytes) {
    ASSERT_TRUE(parse(bytes, "f").ok());
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      // A copy of its own, so that a sanitizer sees any read beyond it.
      const std::string part(bytes.begin(),
                             bytes.begin() + static_cast<std::ptrdiff_t>(n));
      const Status status = parse(part, "f").status();
      ASSERT_EQ(status.code(), StatusCode::kDataLoss) << n << " bytes";
      ASSERT_THAT(status.message(), StartsWith("f "));
    }
    EXPECT_EQ(parse(bytes + "x", "f").status().code(), StatusCode::kDataLoss);
  };
  expect_lost(ParseCamerasBinary, FormatCamerasBinary(model.cameras));
  expect_lost(ParseImagesBinary, FormatImagesBinary(model.images));
  expect_lost(ParsePointsBinary, FormatPointsBinary(model.points));
}

TEST(ColmapBinary, AnyCorruptByteGivesAModelOrAnError) {
  const std::string files[] = {kCamera, kImage, kPoint};
  int num_errors = 0;
  for (int file = 0; file < 3; ++file) {
    for (std::size_t i = 0; i < files[file].size(); ++i) {
      std::string bytes[] = {files[0], files[1], files[2]};
      bytes[file][i] = static_cast<char>(~bytes[file][i]);
      const TemporaryFolder folder;
      folder.Write("cameras.bin", bytes[0]);
      folder.Write("images.bin", bytes[1]);
      folder.Write("points3D.bin", bytes[2]);
      num_errors += ReadColmapModel(folder.path()).ok() ? 0 : 1;
    }
  }
  EXPECT_GT(num_errors, 40);  // counts, ids, sizes, exponents
}

TEST(ColmapBinary, HostileCountsAllocateNothing) {
  for (const U64 count : {U64{1} << 63, ~U64{0}, U64{1} << 40, U64{1000}}) {
    const std::string filler(1000, 'x');
    EXPECT_FALSE(ParseCamerasBinary(Bytes(count) + filler, "f").ok());
    EXPECT_FALSE(ParseImagesBinary(Bytes(count) + filler, "f").ok());
    EXPECT_FALSE(ParsePointsBinary(Bytes(count) + filler, "f").ok());
    std::string image = kImage;
    image.replace(kImage.size() - 7 * sizeof(U64), sizeof(U64), Bytes(count));
    EXPECT_FALSE(ParseImagesBinary(image, "f").ok());
    std::string point = kPoint;
    point.replace(kPoint.size() - 2 * sizeof(U64), sizeof(U64), Bytes(count));
    EXPECT_FALSE(ParsePointsBinary(point, "f").ok());
  }
}

TEST(ColmapBinary, NamesWithoutAnEndAreErrors) {
  std::string image =
      kImage.substr(0, kImage.find("a b.png")) + std::string(200, 'n');
  EXPECT_THAT(ParseImagesBinary(image, "images.bin").status().message(),
              HasSubstr("images.bin ends inside image 1 of 1"));
}

TEST(ColmapBinary, UnsupportedCameraModelsAreNamed) {
  const std::string panorama =
      Bytes(U64{1}, U32{7}, I32{17}, U64{64}, U64{32}, 64., 32.);
  const Status equirectangular =
      ParseCamerasBinary(panorama, "cameras.bin").status();
  EXPECT_EQ(equirectangular.code(), StatusCode::kUnsupported);
  EXPECT_THAT(equirectangular.message(),
              HasSubstr("camera 7 has the camera model EQUIRECTANGULAR"));
  std::string other = kCamera;
  other.replace(8 + 4, 4, Bytes(I32{99}));
  EXPECT_THAT(ParseCamerasBinary(other, "cameras.bin").status().message(),
              HasSubstr("model with id 99"));
  std::string huge = kCamera;
  huge.replace(8 + 8, 8, Bytes(~U64{0}));
  EXPECT_EQ(ParseCamerasBinary(huge, "f")->front().camera.width, 0);
}

TEST(ColmapBinary, ReadingNamesTheFileThatIsAtFault) {
  const TemporaryFolder folder;
  folder.Write("cameras.bin", kCamera);
  folder.Write("points3D.bin", kPoint);
  std::string image = kImage;
  image.replace(8 + 4 + 24, 8, Bytes(0.));  // quaternion 0
  folder.Write("images.bin", image);
  EXPECT_THAT(ReadColmapModel(folder.path()).status().message(),
              HasSubstr("images.bin: image 9 (a b.png) has a rotation that is "
                        "zero"));
  image = kImage;
  image.replace(8 + 4 + 7 * 8, 4, Bytes(U32{8}));
  folder.Write("images.bin", image);
  EXPECT_THAT(ReadColmapModel(folder.path()).status().message(),
              HasSubstr("images.bin: image 9 (a b.png) was taken by camera 8"));
  EXPECT_THAT(ReadColmapModel(folder.path() / "none").status().message(),
              HasSubstr("none holds no COLMAP model"));
}

TEST(ColmapText, AcceptsWhatPeopleAndProgramsWrite) {
  const CamerasOrError cameras = ParseAllCamerasText(
      "\xEF\xBB\xBF# comment\r\n\r\n  3   PINHOLE\t9 8 1e2 +100 4.5 4\r\n# end",
      "c");
  ASSERT_TRUE(cameras.ok()) << cameras.status().message();
  ASSERT_EQ(cameras->size(), 1u);
  EXPECT_EQ((*cameras)[0].camera.params,
            (std::vector<double>{100, 100, 4.5, 4}));

  const ImagesOrError images = ParseImagesText(
      "# comment\n"
      "1 1 0 0 0 0 0 0 3 sub/my photo (1).jpg\n"
      "\n"
      "# comment between images\n"
      "\n"
      "2 1 0 0 0 0 0 0 3 b.jpg\r\n"
      "# comment inside an image\n"
      "1.5 2.5 -1 3 4 17 -1 -1 0\n"
      "3 1 0 0 0 0 0 0 3 c.jpg",
      "i");
  ASSERT_TRUE(images.ok()) << images.status().message();
  ASSERT_EQ(images->size(), 3u);
  EXPECT_EQ((*images)[0].name, "sub/my photo (1).jpg");
  EXPECT_TRUE((*images)[0].points2D.empty());
  EXPECT_EQ((*images)[1].name, "b.jpg");
  ASSERT_EQ((*images)[1].points2D.size(), 3u);
  EXPECT_EQ((*images)[1].points2D[0].point3D_id, kNoPoint3D);
  EXPECT_EQ((*images)[1].points2D[1].point3D_id, 17u);
  EXPECT_EQ((*images)[1].points2D[2].x, -1);
  EXPECT_EQ((*images)[2].name, "c.jpg");

  const PointsOrError points = ParsePointsText(
      "# none yet\n5 1 2 3 255 0 7 -1\n6 1 2 3 1 2 3 0.5 1 2", "p");
  ASSERT_TRUE(points.ok()) << points.status().message();
  EXPECT_TRUE((*points)[0].track.empty());
  EXPECT_EQ((*points)[1].track[0].point2D_idx, 2u);
}

TEST(ColmapText, MalformedLinesAreNamed) {
  const auto camera = [](const std::string& text) {
    return ParseAllCamerasText(text, "cameras.txt").status();
  };
  const auto image = [](const std::string& text) {
    return ParseImagesText(text, "images.txt").status();
  };
  const auto point = [](const std::string& text) {
    return ParsePointsText(text, "points3D.txt").status();
  };
  const std::string pose = "1 1 0 0 0 0 0 0 3 a.png\n";
  for (const auto& [status, sentence] :
       std::vector<std::pair<Status, std::string>>{
           {camera("# x\n1 PINHOLE 9 9 1 1 1\n"),
            "cameras.txt, line 2 is not \"CAMERA_ID PINHOLE WIDTH HEIGHT and 4 "
            "numbers\""},
           {camera("1 PINHOLE 9 9 1 1 1 1 1"), "4 numbers"},
           {camera("1 PINHOLE 9 9 1 1 1 one"), "4 numbers"},
           {camera("1 PINHOLE 9"), "line 1"},
           {camera("-1 PINHOLE 9 9 1 1 1 1"), "line 1"},
           {camera("1 PINHOLE 99999999999 9 1 1 1 1"), "line 1"},
           {camera("7 EQUIRECTANGULAR 64 32 64 32"),
            "camera 7 has the camera model EQUIRECTANGULAR"},
           {camera("1 FISHEYE9 9 9 1 1 1 1"), "camera model FISHEYE9"},
           {image("1 1 0 0 0 0 0 0 3\n\n"), "images.txt, line 1"},
           {image("1 1 0 0 0 0 zero 0 3 a.png\n\n"), "images.txt, line 1"},
           {image(pose + "1 2\n"), "images.txt, line 2"},
           {image(pose + "1 2 -2\n"), "images.txt, line 2"},
           {image(pose + pose), "an image takes two lines"},
           {image("# x\n" + pose + "\n" + pose + "\n"),
            "images.txt, line 4 has the image id 1 of line 2; give one"},
           {point("1 2 3 4 256 0 0 1"), "points3D.txt, line 1"},
           {point("1 2 3 4 5 0 0"), "points3D.txt, line 1"},
           {point("1 2 3 4 5 0 0 1 1"), "points3D.txt, line 1"}}) {
    EXPECT_FALSE(status.ok()) << sentence;
    EXPECT_THAT(status.message(), HasSubstr(sentence));
  }
}

TEST(ColmapText, EveryTruncationGivesAModelOrAnError) {
  ColmapModel model = RandomModel(1);
  model.points.resize(5);
  const std::string cameras = FormatCamerasText(model.cameras);
  const std::string images = FormatImagesText(model.images);
  const std::string points = FormatPointsText(model.points);
  int num_errors = 0;
  const auto parse = [&](const auto& parse_text, const std::string& text) {
    for (std::size_t n = 0; n < text.size(); ++n) {
      const std::string part(text.begin(),
                             text.begin() + static_cast<std::ptrdiff_t>(n));
      num_errors += parse_text(part, "f").ok() ? 0 : 1;
    }
  };
  parse(ParseAllCamerasText, cameras);
  parse(ParseImagesText, images);
  parse(ParsePointsText, points);
  EXPECT_GT(num_errors, 1000);
}

TEST(ColmapText, NumbersThatAreNotFiniteAreRefused) {
  const TemporaryFolder folder;
  folder.Write("cameras.txt", "3 PINHOLE 9 9 5 5 4 4\n");
  for (const std::string pose : {"1 nan 0 0 0 0 0 0 3 a.png",
                                 "1 0 0 0 0 0 0 0 3 a.png",
                                 "1 1 0 0 0 inf 0 0 3 a.png"}) {
    folder.Write("images.txt", pose + "\n\n");
    EXPECT_THAT(ReadColmapModel(folder.path()).status().message(),
                HasSubstr("images.txt: image 1 (a.png) has a"));
  }
}

}  // namespace
}  // namespace curvix
