// SPDX-License-Identifier: BSD-3-Clause
// What `align` reads and writes.
#include "plugin/export/alignment_file.h"

#include <string>
#include <vector>

#include "base/file_io.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/align/known_structures.h"
#include "plugin/align/positions.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

WorldAlignment SomeAlignment() {
  WorldAlignment a;
  a.world_from_model.scale = 2.5;
  a.world_from_model.rotation =
      Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized());
  a.world_from_model.translation = {1, 2, 3};
  a.covariance(0, 0) = 1e-4;
  a.covariance(1, 5) = a.covariance(5, 1) = 1e-7;
  a.has_scale = true;
  a.unit = "mm";
  a.crs = "EPSG:25832";
  a.offset = {100, 200, 0};
  return a;
}

TEST(AlignmentFile, ComesBack) {
  const TemporaryFolder folder;
  const WorldAlignment a = SomeAlignment();
  ASSERT_TRUE(WriteFileAtomically(folder.path() / kAlignmentName,
                                  AlignmentJson(a).dump(2))
                  .ok());
  const auto read = ReadAlignment(folder.path());
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_TRUE(read->has_value());
  const WorldAlignment& b = **read;
  EXPECT_EQ(b.world_from_model.scale, a.world_from_model.scale);
  EXPECT_LT((b.world_from_model * Vector3d(1, 1, 1) -
             a.world_from_model * Vector3d(1, 1, 1))
                .norm(),
            1e-14);
  EXPECT_EQ(b.covariance, a.covariance);
  EXPECT_EQ(b.unit, a.unit);
  EXPECT_EQ(b.crs, a.crs);
  EXPECT_EQ(b.offset, a.offset);
  EXPECT_TRUE(b.has_scale);
  EXPECT_FALSE(b.has_rotation);
}

TEST(AlignmentFile, IsNotNeeded) {
  const TemporaryFolder folder;
  const auto read = ReadAlignment(folder.path());
  ASSERT_TRUE(read.ok());
  EXPECT_FALSE(read->has_value());
}

TEST(AlignmentFile, IsOfOneModel) {
  const TemporaryFolder folder;
  Scene scene;
  for (int i = 0; i < 4; ++i) {
    View& view = scene.views.emplace_back();
    view.name = "image " + std::to_string(i) + "\xff.png";
    view.cam_from_world.translation = Vector3d(i, i * i, 1);
  }
  Json json = AlignmentJson(SomeAlignment());
  json["cameras"] = CentersJson(scene);
  ASSERT_TRUE(
      WriteFileAtomically(folder.path() / kAlignmentName, json.dump()).ok());
  Scene refined = scene;
  refined.views[2].cam_from_world.translation.x() += 0.01;
  EXPECT_TRUE(ReadAlignment(folder.path(), &refined).ok());
  Scene other = scene;
  for (View& view : other.views) view.cam_from_world.translation *= 2;
  EXPECT_THAT(ReadAlignment(folder.path(), &other).status().message(),
              HasSubstr("another model"));
  EXPECT_TRUE(ReadAlignment(folder.path()).ok());
  Json words = CentersJson(scene);
  words.front() = {"one", "two", "three"};
  for (const Json& wrong : {Json(3), Json::array(), words}) {
    json["cameras"] = wrong;
    ASSERT_TRUE(
        WriteFileAtomically(folder.path() / kAlignmentName, json.dump()).ok());
    EXPECT_FALSE(ReadAlignment(folder.path(), &scene).ok());
  }
}

TEST(AlignmentFile, SaysWhatIsWrongWithIt) {
  const TemporaryFolder folder;
  std::vector<std::string> texts = {"", "{", "[]", "{\"format\":1}"};
  for (const char* member : {"offset", "covariance", "world_from_model"}) {
    Json json = AlignmentJson(SomeAlignment());
    json[member] = {1, 2};
    texts.push_back(json.dump());
  }
  Json negative = AlignmentJson(SomeAlignment());
  negative["world_from_model"]["scale"] = -1;
  texts.push_back(negative.dump());
  for (const std::string& text : texts) {
    ASSERT_TRUE(WriteFileAtomically(folder.path() / kAlignmentName, text).ok());
    const auto read = ReadAlignment(folder.path());
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.status().code(), StatusCode::kDataLoss);
    EXPECT_THAT(read.status().message(),
                HasSubstr("run 'colmap_curvix align'"));
  }
}

KnownStructures TwoNodes() {
  KnownStructures structures;
  for (const double x : {0, 1}) {
    structures.fitted.nodes.push_back(
        {{x, 0, 0}, {}, 1e-6 * Eigen::Matrix3d::Identity()});
  }
  return structures;
}

TEST(ParseDistances, TakesNodesAndPoints) {
  KnownStructures structures = TwoNodes();
  structures.model_from_world.scale = 0.5;
  const auto distances =
      ParseDistances("0 1 1.25;0,0,0 -2,4,6 3 0.1", structures);
  ASSERT_TRUE(distances.ok()) << distances.status().message();
  ASSERT_EQ(distances->size(), 2u);
  EXPECT_EQ(distances->at(0).b, Vector3d(1, 0, 0));
  EXPECT_EQ(distances->at(0).length, 1.25);
  EXPECT_EQ(distances->at(0).sigma, 0);
  EXPECT_EQ(distances->at(1).b, Vector3d(-1, 2, 3));
  EXPECT_NEAR(distances->at(1).covariance_a(0, 0), 1e-6, 1e-12);
  EXPECT_EQ(distances->at(1).sigma, 0.1);
}

TEST(ParseDistances, SaysWhatIsWrong) {
  for (const char* text : {"",
                           "0 1",
                           "0 1 x",
                           "0 1 -1",
                           "0 1 inf",
                           "0 2 1",
                           "0 0 1",
                           "0,0,0 0 1",
                           "-1 1 1",
                           "0,1 1 1",
                           "0,1,2,3 1 1",
                           "0,nan,2 1 1",
                           "0 1 1 -1",
                           "0 1 1 1 1",
                           "0 1 1;"}) {
    const auto distances = ParseDistances(text, TwoNodes());
    ASSERT_FALSE(distances.ok()) << text;
    EXPECT_EQ(distances.status().code(), StatusCode::kInvalidArgument);
    EXPECT_THAT(distances.status().message(), HasSubstr("as in --distance"));
  }
}

TEST(ReadStructures, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  EXPECT_THAT(ReadStructures(folder.path()).status().message(),
              HasSubstr("reconstruct"));
  for (const char* text : {"", "[", "{}", "{\"nodes\":[{}],\"curves\":[]}"}) {
    ASSERT_TRUE(WriteFileAtomically(folder.path() / "curves.json", text).ok());
    const auto read = ReadStructures(folder.path());
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.status().code(), StatusCode::kDataLoss);
  }
}

class Positions : public testing::Test {
 protected:
  Result<CameraPositions> Read(const std::string& text) {
    const auto path = folder_.path() / "positions.txt";
    EXPECT_TRUE(WriteFileAtomically(path, text).ok());
    return ReadPositions(path, scene_);
  }

  TemporaryFolder folder_;
  Scene scene_ =
      ToScene({LookAt({5, 1, 1}, {0, 0, 0}), LookAt({1, 5, 1}, {0, 0, 0})});
};

TEST_F(Positions, AreThoseOfTheCameras) {
  const auto read = Read(
      "# name x y z\n"
      "view_001, 10, 20, 30\r\n"
      "\n"
      "view_000 1 2 3 0.5 # good\n"
      "other 1 2 3\n");
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->positions.size(), 2u);
  EXPECT_LT((read->positions[0].model - Vector3d(1, 5, 1)).norm(), 1e-9);
  EXPECT_EQ(read->positions[0].world, Vector3d(10, 20, 30));
  EXPECT_EQ(read->positions[0].sigma, 0);
  EXPECT_EQ(read->positions[1].sigma, 0.5);
  ASSERT_EQ(read->notes.size(), 1u);
  EXPECT_THAT(read->notes[0], HasSubstr("positions.txt names "));
  EXPECT_THAT(read->notes[0], HasSubstr("other (line 5)"));
}

TEST_F(Positions, NamesMayHoldWhatIsBetweenNumbers) {
  const char* const kNames[] = {
      "my view 1.jpg", "a #1.jpg", "b,c;d.jpg", "e.jpg", "f 7"};
  scene_.views.resize(5, scene_.views.front());
  for (std::size_t i = 0; i < 5; ++i) scene_.views[i].name = kNames[i];
  const auto read = Read(
      "\xEF\xBB\xBFmy view 1.jpg 1 2 3\n"
      "a #1.jpg 1 2 3 0.5 # 4 5 6\n"
      "b,c;d.jpg,1,2,3\n"
      "\"e.jpg\"; 1; 2; 3\n"
      "f 7 1 2 3\n");
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_THAT(read->notes, testing::IsEmpty());
  ASSERT_EQ(read->positions.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(read->positions[i].name, kNames[i]);
    EXPECT_EQ(read->positions[i].world, Vector3d(1, 2, 3));
    EXPECT_EQ(read->positions[i].sigma, i == 1 ? 0.5 : 0);
  }
}

TEST_F(Positions, UnknownNamesAreOneNote) {
  std::string text = "view_000 1 2 3\n";
  for (int i = 0; i < 1000; ++i) {
    text += "IMG_" + std::to_string(i) + ".jpg 1 2 3\n";
  }
  const auto read = Read(text);
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->notes.size(), 1u);
  EXPECT_THAT(read->notes[0], HasSubstr("IMG_0.jpg"));
  EXPECT_THAT(read->notes[0], HasSubstr("995 more"));
}

TEST_F(Positions, ThatCannotBeReadAreNamed) {
  EXPECT_THAT(Read("view_000 1 2\n").status().message(), HasSubstr("line 1"));
  EXPECT_THAT(Read("\nview_000 1 2 x\n").status().message(),
              HasSubstr("line 2"));
  EXPECT_FALSE(Read("view_000 1 2 3 0\n").ok());
  EXPECT_FALSE(Read("view_000 1 2 3 1 1\n").ok());
  EXPECT_FALSE(Read("view_000 1 2 nan\n").ok());
  EXPECT_THAT(Read("view_000 1 2 3\nview_000 1 2 3\n").status().message(),
              HasSubstr("once more"));
  EXPECT_THAT(Read("a 1 2 3\n").status().message(), HasSubstr("view_000"));
  EXPECT_EQ(ReadPositions(folder_.path() / "none", scene_).status().code(),
            StatusCode::kNotFound);
}

}  // namespace
}  // namespace curvix
