// SPDX-License-Identifier: BSD-3-Clause
// Lines of other programs, in each of their formats, come back as they were.
#include "plugin/imports/read_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <string>

#include "tests/support/temporary_folder.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Two lines; images 3, 7, 3 show the first, image 9 the second.
std::string AllTracks() {
  return "2\n"
         "0 3 2\n1.5 2 -3\n1.25 2   4e1\n3 7 3 \n0 11 5 \n"
         "1 1 1\n0 0 0\n0.1 0.2 0.3\n9 \n4 \n";
}

std::string Track(int i) {
  return i == 0 ? "1.5 2 -3 1.25 2 4e1 \n3 2\nimage_id_list 3 7 3 \n"
                  "line_id_list 0 11 5 \nline2d_list\n1 2 3 4 \n1 2 3 4 \n"
                  "1 2 3 4 \nEND\n"
                : "0 0 0 0.1 0.2 0.3 \n1 1\nimage_id_list 9 \n"
                  "line_id_list 4 \nEND\n";
}

std::string Line3dpp() {
  return "1 1.5 2 -3 1.25 2 4e1 3 3 0 1 2 3 4 7 11 1 2 3 4 3 5 1 2 3 4\n"
         "1 0 0 0 0.1 0.2 0.3 1 9 4 10.5 20.5 30.5 40.5\n";
}

class ReadLines : public testing::Test {
 protected:
  static void ExpectBoth(const Result<std::vector<ImportedLine>>& lines) {
    ASSERT_TRUE(lines.ok()) << lines.status().message();
    ASSERT_EQ(lines->size(), 2u);
    EXPECT_EQ((*lines)[0].start, Eigen::Vector3d(1.5, 2, -3));
    EXPECT_EQ((*lines)[0].end, Eigen::Vector3d(1.25, 2, 40));
    EXPECT_THAT((*lines)[0].image_ids, ElementsAre(3, 7, 3));
    EXPECT_EQ((*lines)[1].end, Eigen::Vector3d(0.1, 0.2, 0.3));
    EXPECT_THAT((*lines)[1].image_ids, ElementsAre(9));
  }

  TemporaryFolder folder_;
};

TEST_F(ReadLines, LimapInItsFormats) {
  ExpectBoth(ReadLimapLines(folder_.Write("all/alltracks.txt", AllTracks())));
  ExpectBoth(ReadLimapLines(folder_.path() / "all"));
  folder_.Write("run/finaltracks/track_0.txt", Track(0));
  folder_.Write("run/finaltracks/track_1.txt", Track(1));
  ExpectBoth(ReadLimapLines(folder_.path() / "run/finaltracks"));
  ExpectBoth(ReadLimapLines(folder_.path() / "run"));
}

TEST_F(ReadLines, Line3dppInItsFormats) {
  ExpectBoth(ReadLine3dppLines(folder_.Write("a/Line3D++__1.txt", Line3dpp())));
  ExpectBoth(ReadLine3dppLines(folder_.path() / "a"));
  // A track of several segments: all of them have its images.
  const auto lines = ReadLine3dppLines(folder_.Write(
      "b.txt", "2 0 0 0 1 0 0 2 0 0 3 0 0 2 5 0 1 2 3 4 6 0 1 2 3 4\n"));
  ASSERT_TRUE(lines.ok()) << lines.status().message();
  ASSERT_EQ(lines->size(), 2u);
  EXPECT_EQ((*lines)[1].start.x(), 2);
  EXPECT_THAT((*lines)[0].image_ids, ElementsAre(5, 6));
  EXPECT_THAT((*lines)[1].image_ids, ElementsAre(5, 6));
}

TEST_F(ReadLines, ObjHasNoImages) {
  const fs::path path = folder_.Write(
      "a.OBJ",
      "\xEF\xBB\xBFv 0 0 1\nv 1 0 1\nv 0 2 1\nv 0 2 3\nl 1 2\nl 3 4\n");
  for (const auto& lines : {ReadLimapLines(path), ReadLine3dppLines(path)}) {
    ASSERT_TRUE(lines.ok()) << lines.status().message();
    ASSERT_EQ(lines->size(), 2u);
    EXPECT_EQ((*lines)[1].end, Eigen::Vector3d(0, 2, 3));
    EXPECT_THAT((*lines)[1].image_ids, IsEmpty());
  }
}

TEST_F(ReadLines, TextMayBeginWithAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  ExpectBoth(ReadLimapLines(folder_.Write("a.txt", mark + AllTracks())));
  ExpectBoth(ReadLine3dppLines(folder_.Write("b.txt", mark + Line3dpp())));
}

TEST_F(ReadLines, WhateverIsCutOffIsRefusedWithItsLine) {
  const auto expect_broken = [&](const std::string& text, const auto& read) {
    for (std::size_t size = 1; size + 4 < text.size(); ++size) {
      const auto lines =
          read(folder_.Write("broken.txt", text.substr(0, size)));
      if (lines.ok()) {
        EXPECT_LT(lines->size(), 2u) << size;
      } else {
        EXPECT_EQ(lines.status().code(), StatusCode::kDataLoss) << size;
        EXPECT_THAT(lines.status().message(), HasSubstr("broken.txt, line "));
      }
    }
  };
  expect_broken(AllTracks(), ReadLimapLines);
  expect_broken(Line3dpp(), ReadLine3dppLines);
}

TEST_F(ReadLines, CountsAndNumbersAreNotBelieved) {
  for (const char* text : {"4000000000\n0 4000000000 1\n0 0 0\n1 1 1\n",
                           "-1\n",
                           "1\n0 1 1\nnan 0 0\n1 1 1\n3\n4\n",
                           "1\n0 1 1\n1e999 0 0\n1 1 1\n3\n4\n",
                           "1\n0 1 1\n0 0 0\n1 1 1\n-3\n4\n",
                           "PNG"}) {
    EXPECT_EQ(ReadLimapLines(folder_.Write("a.txt", text)).status().code(),
              StatusCode::kDataLoss)
        << text;
  }
  EXPECT_EQ(ReadLimapLines(folder_.Write("a.txt", "0\n")).status().code(),
            StatusCode::kUnsupported);
  EXPECT_EQ(ReadLine3dppLines(folder_.Write("a.txt", "")).status().code(),
            StatusCode::kUnsupported);
}

TEST_F(ReadLines, FoldersWithoutThemAreNotFound) {
  for (const auto& read : {ReadLimapLines, ReadLine3dppLines}) {
    const auto lines = read(folder_.path());
    EXPECT_EQ(lines.status().code(), StatusCode::kNotFound);
    EXPECT_THAT(lines.status().message(), HasSubstr("--input_path"));
  }
  // Of three, one is missing.
  folder_.Write("track_0.txt", Track(0));
  folder_.Write("track_2.txt", Track(1));
  EXPECT_EQ(ReadLimapLines(folder_.path()).status().code(),
            StatusCode::kNotFound);
}

// Three cameras with the image ids 1, 2 and 3; the third looks away.
Scene TestScene() {
  return ToScene({LookAt({5, 0, 1}, {0, 0, 0}),
                  LookAt({0, 5, 1}, {0, 0, 0}),
                  LookAt({5, 5, 1}, {10, 10, 1})});
}

TEST(CurvesOfLines, ViewsSupportWhatTheyShow) {
  const Scene scene = TestScene();
  const ImportedLine line = {{-0.5, 0.1, 0}, {0.5, 0.2, 0.3}, {3, 99, 2, 2, 1}};
  const auto result = CurvesOfLines({line}, scene);
  ASSERT_TRUE(result.ok()) << result.status().message();
  ASSERT_EQ(result->curves.curves.size(), 1u);
  const Curve& curve = result->curves.curves[0];
  ASSERT_EQ(curve.samples.size(), 2u);
  EXPECT_EQ(curve.samples[0].position, line.start);
  EXPECT_EQ(curve.samples[1].position, line.end);
  for (const CurveSample& sample : curve.samples) {
    ASSERT_EQ(sample.support.size(), 2u);
    for (int v = 0; v < 2; ++v) {
      const auto i = static_cast<std::size_t>(v);
      EXPECT_EQ(sample.support[i].view_idx, v);
      const Edge2d& edge = result->edge_maps[i].edges.at(
          static_cast<std::size_t>(sample.support[i].edge_idx));
      const View& view = scene.views[i];
      const auto seen = [&](const Eigen::Vector3d& point) {
        return *ProjectPoint(point, view, scene.cameras[i]);
      };
      EXPECT_LT((edge.position - seen(sample.position)).norm(), 1e-9);
      const Eigen::Vector2d along = seen(line.end) - seen(line.start);
      EXPECT_NEAR(std::cos(edge.angle), along.normalized().x(), 1e-6);
      EXPECT_NEAR(std::sin(edge.angle), along.normalized().y(), 1e-6);
    }
  }
}

TEST_F(ReadLines, FilesWithoutLinesAreRefused) {
  for (const char* name : {"empty.obj", "empty.txt"}) {
    const fs::path path = folder_.Write(name, "");
    for (const auto read : {ReadLine3dppLines, ReadLimapLines}) {
      const Status status = read(path).status();
      EXPECT_FALSE(status.ok()) << name;
      EXPECT_THAT(status.message(), HasSubstr(name));
    }
    EXPECT_THAT(ReadLine3dppLines(path).status().message(),
                HasSubstr("holds no lines"));
  }
}

TEST(CurvesOfLines, PointsAreLeftOutAndOtherWorldsRefused) {
  const Scene scene = TestScene();
  const ImportedLine line = {{0, 0, 0}, {0, 0, 1}, {}};
  const ImportedLine point = {{0, 0, 0}, {0, 0, 0}, {1}};
  const ImportedLine far = {{0, 0, 900}, {0, 1, 900}, {1}};
  // The focal length is 800 px, and the cameras are 5 * sqrt(2) apart.
  const ImportedLine near = {{0, 0, 0}, {0, 0, 5600}, {1}};
  const ImportedLine endless = {{0, 0, 0}, {0, 0, 6000}, {1}};
  const ImportedLine huge = {{0, 0, 0}, {0, 0, 1e300}, {1}};
  const auto result =
      CurvesOfLines({point, line, far, near, endless, huge}, scene);
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_EQ(result->curves.curves.size(), 3u);
  EXPECT_EQ(result->num_left_out, 3);
  EXPECT_EQ(result->num_seen, 2);
  EXPECT_EQ(CurvesOfLines({far}, scene).status().code(),
            StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace curvix
