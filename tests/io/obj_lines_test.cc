// SPDX-License-Identifier: BSD-3-Clause
#include "io/curve_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/io/test_curves.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST(ObjLines, CurvesComeBackExactly) {
  const CurveSet curves = MakeTestCurves();
  const auto read = DecodeObjLines(EncodedCurves(EncodeObjLines, curves));
  ASSERT_TRUE(read.ok()) << read.status().message();
  // OBJ has no tangents: chords of the circle are parallel to its tangents,
  // those of the helix nearly so.
  ExpectSameGeometry(*read, curves, 0, 0.2);
}

TEST(ObjLines, WritesSegmentsOfTwoVerticesWithColours) {
  CurveSet curves;
  curves.curves.push_back(MakeTestCurves().curves[2]);
  EXPECT_THAT(EncodedCurves(EncodeObjLines, curves),
              MatchesRegex("#[^\n]*\no curve_0\n"
                           "v 0 0 0 [0-9.]+ [0-9.]+ [0-9.]+\n"
                           "v 0.3333333333333333 0 0 [0-9.]+ [0-9.]+ [0-9.]+\n"
                           "l 1 2\n"));
  curves.curves.insert(curves.curves.begin(), MakeTestCurves().curves[1]);
  EXPECT_THAT(EncodedCurves(EncodeObjLines, curves),
              HasSubstr("l 11 12\nl 12 1\no curve_1"));
}

TEST(ObjLines, EmptySetIsAValidFileWithoutCurves) {
  const auto read = DecodeObjLines(EncodedCurves(EncodeObjLines, CurveSet()));
  ASSERT_TRUE(read.ok());
  EXPECT_TRUE(read->curves.empty());
}

TEST(ObjLines, ReadsForeignPolylines) {
  const auto read = DecodeObjLines(
      "mtllib a.mtl\r\nv 0 0 0\r\nv 1 0 0 1.0\r\nv 2 0 0\r\n"
      "vt 0 0\r\nl -3/1 -2/1 -1/1\r\nf 1 2 3\r\n");
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->curves.size(), 1u);
  EXPECT_EQ(read->curves[0].samples.size(), 3u);
  EXPECT_EQ(read->curves[0].samples[2].position, Eigen::Vector3d(2, 0, 0));
}

TEST(ObjLines, BrokenFilesAreReportedWithTheirLine) {
  const auto code = [](const char* bytes) {
    return DecodeObjLines(bytes).status().code();
  };
  EXPECT_EQ(code("v 0 0 0\nv 1 0 0\nl 1 2\n"), StatusCode::kOk);
  EXPECT_EQ(code("v 0 0 0\nv 1 0 0\nl 1 3\n"), StatusCode::kDataLoss);
  EXPECT_EQ(code("v 0 0 0\nv 1 0 0\nl 0 1\n"), StatusCode::kDataLoss);
  EXPECT_EQ(code("v 0 0 0\nv 1 0 0\nl -3 1\n"), StatusCode::kDataLoss);
  EXPECT_EQ(code("v 0 0 0\nl 1 99999999999999999999\n"), StatusCode::kDataLoss);
  EXPECT_EQ(code("v 0 0\nl 1 1\n"), StatusCode::kDataLoss);
  EXPECT_EQ(code("v 0 0 nan\nv 1 0 0\nl 1 2\n"), StatusCode::kDataLoss);
  EXPECT_EQ(code("v 0 0 0\nf 1 1 1\n"), StatusCode::kUnsupported);
  EXPECT_EQ(code("%PDF-1.4\n"), StatusCode::kUnsupported);
  const auto why = [](const char* bytes) {
    return DecodeObjLines(bytes).status().message();
  };
  EXPECT_THAT(why("v 0 0 0\nl x\n"), HasSubstr("line 2"));
  EXPECT_THAT(why("# two\n\nv 0 0 nan\nl 1 1\n"), HasSubstr("line 3"));
  EXPECT_THAT(why("l 1 2\nl 1 4\nv 0 0 0\nl 2 3\nv 1 0 0\n"),
              HasSubstr("line 2 names vertex 4, but the file has 2;"));
}

}  // namespace
}  // namespace curvix
