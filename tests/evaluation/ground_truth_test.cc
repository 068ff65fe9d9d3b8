// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/ground_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;

TEST(ParseGroundTruth, NineColumnsGiveEverything) {
  const auto truth = ParseGroundTruth(
      "\xEF\xBB\xBF# x y z\n\n1 2 3 0 0 1 4 7 5 # here\r\n+1e0 2 3 0 0 1 "
      "4.0 8 6");
  ASSERT_TRUE(truth.ok()) << truth.status().message();
  ASSERT_EQ(truth->samples.size(), 2u);
  EXPECT_EQ(truth->samples[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(truth->samples[0].tangent, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(truth->samples[1].curve_id, 4);
  EXPECT_EQ(truth->samples[1].num_views_seen, 8);
  EXPECT_EQ(truth->samples[1].num_views_edge, 6);
  EXPECT_TRUE(truth->has_tangents && truth->has_curve_ids && truth->has_views);
}

TEST(ParseGroundTruth, MissingColumnsAreMarked) {
  const auto truth = ParseGroundTruth("1 2 3\n4 5 6\n");
  ASSERT_TRUE(truth.ok());
  EXPECT_FALSE(truth->has_tangents || truth->has_curve_ids || truth->has_views);
  EXPECT_TRUE(ParseGroundTruth("1 2 3 1 0 0")->has_tangents);
  EXPECT_FALSE(ParseGroundTruth("1 2 3 1 0 0")->has_curve_ids);
  EXPECT_TRUE(ParseGroundTruth("1 2 3 1 0 0 0")->has_curve_ids);
  EXPECT_FALSE(ParseGroundTruth("1 2 3 1 0 0 0")->has_views);
}

TEST(ParseGroundTruth, ViewsThatSeeStandInForViewsWithAnEdge) {
  const auto truth = ParseGroundTruth("1 2 3 1 0 0 0 9");
  EXPECT_TRUE(truth->has_views);
  EXPECT_EQ(truth->samples[0].num_views_edge, 9);
}

TEST(ParseGroundTruth, TheTenthColumnIsTheKind) {
  const auto truth = ParseGroundTruth(
      "0 0 0 1 0 0 4 7 5 3\n0 0 0 1 0 0 4 7 5 0\n0 0 0 1 0 0 4 7 5 2\n");
  ASSERT_TRUE(truth.ok()) << truth.status().message();
  EXPECT_TRUE(truth->has_kinds);
  EXPECT_EQ(truth->samples[0].kind, CurveKind::kMarking);
  EXPECT_EQ(truth->samples[1].kind, CurveKind::kUnknown);
  EXPECT_EQ(truth->samples[2].kind, CurveKind::kBoundary);
  EXPECT_FALSE(ParseGroundTruth("0 0 0 1 0 0 4 7 5")->has_kinds);
}

TEST(ParseGroundTruth, KindsThatDoNotExistAreReported) {
  for (const char* kind : {"5", "-1", "1.5"}) {
    const auto truth =
        ParseGroundTruth(std::string("0 0 0 1 0 0 4 7 5 ") + kind);
    EXPECT_EQ(truth.status().code(), StatusCode::kDataLoss) << kind;
    EXPECT_THAT(truth.status().message(), HasSubstr("line 1")) << kind;
  }
}

TEST(ParseCurveKinds, GivesTheKindsOfCurves) {
  auto truth = ParseGroundTruth("0 0 0 1 0 0 4\n1 0 0 1 0 0 5\n2 0 0 1 0 0 6");
  const Status status = ParseCurveKinds(
      "# id class views\n4 marking 12\r\n\n6 structure\n9 crease\n", *truth);
  EXPECT_TRUE(status.ok()) << status.message();
  EXPECT_TRUE(truth->has_kinds);
  EXPECT_EQ(truth->samples[0].kind, CurveKind::kMarking);
  EXPECT_EQ(truth->samples[1].kind, CurveKind::kUnknown);
  EXPECT_EQ(truth->samples[2].kind, CurveKind::kUnknown);
}

TEST(ParseCurveKinds, BrokenRowsAreReportedWithTheirLine) {
  auto truth = ParseGroundTruth("0 0 0 1 0 0 4\n");
  for (const char* text : {"4 crease\n5", "4 crease\nx crease"}) {
    const Status status = ParseCurveKinds(text, *truth);
    EXPECT_EQ(status.code(), StatusCode::kDataLoss);
    EXPECT_THAT(status.message(), HasSubstr("line 2"));
  }
  EXPECT_FALSE(truth->has_kinds);
  auto points = ParseGroundTruth("0 0 0\n");
  EXPECT_EQ(ParseCurveKinds("4 crease", *points).code(), StatusCode::kDataLoss);
}

TEST(ReadGroundTruth, TakesAFileOfClassesBesideItUnlessItHasKinds) {
  const TemporaryFolder folder;
  folder.Write("gt_class.txt", "4 boundary\n");
  const auto plain = folder.Write("gt.txt", "0 0 0 1 0 0 4 9 9\n");
  EXPECT_EQ(ReadGroundTruth(plain)->samples[0].kind, CurveKind::kBoundary);
  folder.Write("gt.txt", "0 0 0 1 0 0 4 9 9 1\n");
  EXPECT_EQ(ReadGroundTruth(plain)->samples[0].kind, CurveKind::kCrease);
  folder.Write("gt.txt", "0 0 0\n");
  EXPECT_THAT(ReadGroundTruth(plain).status().message(),
              HasSubstr("gt_class.txt: the ground truth has no curve ids."));
}

TEST(ParseGroundTruth, OtherCountsOfColumnsAreReported) {
  for (const char* text :
       {"1 2", "1 2 3 1", "1 2 3 1 0", "1 2 3 1 0 0 4 7 5 3 1"}) {
    const auto truth = ParseGroundTruth(text);
    EXPECT_EQ(truth.status().code(), StatusCode::kDataLoss) << text;
    EXPECT_THAT(truth.status().message(), HasSubstr("line 1")) << text;
  }
}

TEST(ParseGroundTruth, BrokenRowsAreReportedWithTheirLine) {
  for (const char* text : {"0 0 0\n1 2\n",
                           "0 0 0\n1 2 x\n",
                           "0 0 0\n1 2 nan\n",
                           "0 0 0\n1 2 3 4\n",
                           "0 0 0\n1 2 1e999\n"}) {
    const auto truth = ParseGroundTruth(text);
    EXPECT_EQ(truth.status().code(), StatusCode::kDataLoss) << text;
    EXPECT_THAT(truth.status().message(), HasSubstr("line 2")) << text;
  }
  EXPECT_EQ(ParseGroundTruth("# only\n").status().code(),
            StatusCode::kDataLoss);
}

}  // namespace
}  // namespace curvix
