// SPDX-License-Identifier: BSD-3-Clause
#include "io/curve_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/io/test_curves.h"

namespace curvix {
namespace {

using ::testing::EndsWith;

TEST(TxtCurves, EverythingComesBackExactly) {
  CurveSet curves = MakeTestCurves();
  curves.curves[0].samples[1].kind = CurveKind::kOccludingContour;
  const Scene scene = MakeTestScene();
  const auto read =
      DecodeTxtCurves(EncodedCurves(EncodeTxtCurves, curves, scene), scene);
  ASSERT_TRUE(read.ok()) << read.status().message();
  ExpectSameGeometry(*read, curves, 0, 0);
  for (std::size_t c = 0; c < curves.curves.size(); ++c) {
    for (std::size_t i = 0; i < curves.curves[c].samples.size(); ++i) {
      const CurveSample& sample = curves.curves[c].samples[i];
      EXPECT_EQ(read->curves[c].samples[i].sigma, sample.sigma);
      EXPECT_EQ(read->curves[c].samples[i].kind, sample.kind);
      EXPECT_EQ(read->curves[c].samples[i].support, sample.support);
    }
  }
}

TEST(TxtCurves, LinesAreAsDocumented) {
  CurveSet curves;
  curves.curves.push_back(MakeTestCurves().curves[2]);
  curves.curves[0].samples[0].sigma = 0.5;
  curves.curves[0].samples[0].kind = CurveKind::kMarking;
  curves.curves[0].samples[0].support = {{0, 9}, {2, 4}};
  EXPECT_THAT(EncodedCurves(EncodeTxtCurves, curves, MakeTestScene()),
              EndsWith("# Number of curves: 1\n"
                       "0 0 2\n"
                       "0 0 0 1 0 0 0.5 marking 7 4000000000\n"
                       "0.3333333333333333 0 0 1 0 0 0 unknown\n"));
}

TEST(TxtCurves, AnEmptySceneReadsTheGeometryAlone) {
  const std::string text =
      EncodedCurves(EncodeTxtCurves, MakeTestCurves(), MakeTestScene());
  const auto read = DecodeTxtCurves(text, {});
  ASSERT_TRUE(read.ok());
  EXPECT_TRUE(read->curves[0].samples[3].support.empty());
}

TEST(TxtCurves, EmptySetIsAValidFileWithoutCurves) {
  const auto read =
      DecodeTxtCurves(EncodedCurves(EncodeTxtCurves, CurveSet(), Scene()), {});
  ASSERT_TRUE(read.ok());
  EXPECT_TRUE(read->curves.empty());
}

TEST(TxtCurves, BrokenFilesAreReported) {
  const auto code = [](const char* bytes) {
    return DecodeTxtCurves(bytes, {}).status().code();
  };
  EXPECT_EQ(code("0 0 2\n0 0 0 1 0 0 0 crease\n1 0 0 1 0 0 0 crease\n"),
            StatusCode::kOk);
  EXPECT_EQ(code("0 0 2\n0 0 0 1 0 0 0 crease\n"), StatusCode::kDataLoss);
  EXPECT_EQ(code("0 0 2\n0 0 0 1 0 0 0 crease\n1 0 0 1 0 0\n"),
            StatusCode::kDataLoss);
  EXPECT_EQ(code("0 0 2\n0 0 0 1 0 0 0 crease\n1 0 0 1 0 0 inf crease\n"),
            StatusCode::kDataLoss);
  EXPECT_EQ(code("0 0 2\n0 0 0 1 0 0 0 crease -1\n1 0 0 1 0 0 0 crease\n"),
            StatusCode::kDataLoss);
  EXPECT_EQ(code("0 0 2\n0 0 0 1 0 0 0 paint\n1 0 0 1 0 0 0 crease\n"),
            StatusCode::kDataLoss);
  EXPECT_EQ(code("0 0 99999999999999\n0 0 0 1 0 0 0 crease\n"),
            StatusCode::kDataLoss);
  EXPECT_EQ(code("0 0 18446744073709551615\n"), StatusCode::kDataLoss);
  EXPECT_EQ(code("0 0 1\n0 0 0 1 0 0 0 crease\n"), StatusCode::kDataLoss);
  EXPECT_EQ(code("0 2 2\n0 0 0 1 0 0 0 crease\n1 0 0 1 0 0 0 crease\n"),
            StatusCode::kDataLoss);
  EXPECT_EQ(code("ply\n"), StatusCode::kDataLoss);
}

}  // namespace
}  // namespace curvix
