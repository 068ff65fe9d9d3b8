// SPDX-License-Identifier: BSD-3-Clause
#include "io/curve_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <bit>
#include <string>

#include "base/bytes.h"
#include "tests/io/test_curves.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kFloat = 2e-7;  // relative error of float, positions up to 2

std::string AsciiPly(const std::string& vertices, const std::string& edges) {
  return "ply\nformat ascii 1.0\n" + vertices + edges;
}

TEST(PlyLines, HeaderNamesExactlyThePropertiesThatViewersAccept) {
  const std::string bytes = EncodedCurves(EncodePlyLines, MakeTestCurves(), "");
  EXPECT_THAT(
      bytes,
      StartsWith("ply\n"
                 "format binary_little_endian 1.0\n"
                 "comment curvix: coordinates are those of the COLMAP model\n"
                 "element vertex 23\n"
                 "property float x\n"
                 "property float y\n"
                 "property float z\n"
                 "property float tx\n"
                 "property float ty\n"
                 "property float tz\n"
                 "property uchar red\n"
                 "property uchar green\n"
                 "property uchar blue\n"
                 "property float curve_id\n"
                 "property float confidence\n"
                 "property float support\n"
                 "element edge 21\n"
                 "property int vertex1\n"
                 "property int vertex2\n"
                 "end_header\n"));
}

TEST(PlyLines, RowsFollowTheHeaderInOrder) {
  const CurveSet curves = MakeTestCurves();
  const std::string bytes = EncodedCurves(EncodePlyLines, curves, "");
  const std::string end = "end_header\n";
  const char* body = bytes.data() + bytes.find(end) + end.size();
  constexpr std::ptrdiff_t kVertexBytes = 9 * 4 + 3;
  constexpr std::ptrdiff_t kEdgeBytes = 8;
  EXPECT_EQ(bytes.data() + bytes.size(),
            body + 23 * kVertexBytes + 21 * kEdgeBytes);
  for (int i = 0; i < 9; ++i) {
    const CurveSample& sample =
        curves.curves[0].samples[static_cast<std::size_t>(i)];
    const char* row = body + i * kVertexBytes;
    for (std::ptrdiff_t k = 0; k < 3; ++k) {
      EXPECT_EQ(LoadBytes<float>(row + 4 * k, std::endian::little),
                static_cast<float>(sample.position[k]));
      EXPECT_EQ(LoadBytes<float>(row + 12 + 4 * k, std::endian::little),
                static_cast<float>(sample.tangent[k]));
    }
    const float n = static_cast<float>(sample.support.size());
    EXPECT_EQ(LoadBytes<float>(row + 27, std::endian::little), 0);
    EXPECT_EQ(LoadBytes<float>(row + 31, std::endian::little), n / (n + 4));
    EXPECT_EQ(LoadBytes<float>(row + 35, std::endian::little), n);
  }
  // The last edge of the circle, vertices 9 to 20, closes it.
  const char* closing = body + 23 * kVertexBytes + (8 + 11) * kEdgeBytes;
  EXPECT_EQ(LoadBytes<std::int32_t>(closing, std::endian::little), 20);
  EXPECT_EQ(LoadBytes<std::int32_t>(closing + 4, std::endian::little), 9);
}

TEST(PlyLines, KindsAreWrittenWhereAnyIsKnownAndComeBack) {
  CurveSet curves = MakeTestCurves();
  const std::size_t unknown = EncodedCurves(EncodePlyLines, curves, "").size();
  CurveSample& sample = curves.curves[1].samples[2];
  sample.kind = CurveKind::kMarking;
  sample.kind_probability = 0.75F;
  const std::string bytes = EncodedCurves(EncodePlyLines, curves, "");
  const std::string properties =
      "property uchar kind\nproperty float kind_probability\n";
  EXPECT_EQ(bytes.size(), unknown + properties.size() + 23 * 5);
  EXPECT_THAT(bytes,
              HasSubstr("property float support\n" + properties + "element"));
  const auto read = DecodePlyLines(bytes);
  ASSERT_TRUE(read.ok()) << read.status().message();
  for (std::size_t c = 0; c < curves.curves.size(); ++c) {
    for (std::size_t i = 0; i < curves.curves[c].samples.size(); ++i) {
      const CurveSample& back = read->curves[c].samples[i];
      EXPECT_EQ(back.kind, curves.curves[c].samples[i].kind);
      EXPECT_EQ(back.kind_probability,
                curves.curves[c].samples[i].kind_probability);
    }
  }
}

TEST(PlyLines, CurvesComeBackInOrderClosedAndOpen) {
  const CurveSet curves = MakeTestCurves();
  const auto read = DecodePlyLines(EncodedCurves(EncodePlyLines, curves, ""));
  ASSERT_TRUE(read.ok()) << read.status().message();
  ExpectSameGeometry(*read, curves, kFloat, kFloat);
}

TEST(PlyLines, EmptySetIsAValidFileWithoutCurves) {
  const std::string bytes = EncodedCurves(EncodePlyLines, CurveSet(), "");
  EXPECT_THAT(bytes, HasSubstr("element vertex 0\n"));
  const auto read = DecodePlyLines(bytes);
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_TRUE(read->curves.empty());
}

TEST(PlyLines, TwoSamplesCannotClose) {
  CurveSet curves;
  curves.curves.push_back(MakeTestCurves().curves[2]);
  curves.curves[0].closed = true;
  EXPECT_THAT(EncodedCurves(EncodePlyLines, curves, ""),
              HasSubstr("element edge 1\n"));
}

TEST(PlyLines, EdgesArePointsWithDirectionAndSupport) {
  Edge3d edge;
  edge.position = {1, 2, 3};
  edge.tangent = {0, -1, 0};
  edge.support = {{0, 5}, {2, 1}};
  const std::string bytes = Encoded(EncodePlyEdges, std::vector<Edge3d>{edge});
  EXPECT_THAT(bytes, HasSubstr("element vertex 1\n"));
  EXPECT_THAT(bytes, HasSubstr("property float support\nend_header\n"));
  const char* row = bytes.data() + bytes.size() - (7 * 4 + 3);
  EXPECT_EQ(LoadBytes<float>(row + 16, std::endian::little), -1);
  EXPECT_EQ(std::string(row + 24, 3), std::string("\x00\xff\x00", 3));
  EXPECT_EQ(LoadBytes<float>(row + 27, std::endian::little), 2);
  EXPECT_EQ(DecodePlyLines(bytes).status().code(), StatusCode::kUnsupported);
}

TEST(PlyLines, ReadsForeignAsciiWithOtherElementsAndLists) {
  const auto read = DecodePlyLines(
      "ply\r\nformat ascii 1.0\r\ncomment by hand\r\n"
      "element face 2\r\nproperty list uchar int vertex_indices\r\n"
      "element edge 2\r\nproperty uchar red\r\nproperty uint vertex2\r\n"
      "property uint vertex1\r\n"
      "element vertex 3\r\nproperty double z\r\nproperty short y\r\n"
      "property list uchar float weights\r\nproperty float x\r\n"
      "end_header\r\n"
      "3 0 1 2\r\n0\r\n"
      "255 1 0\r\n0 2 1\r\n"
      "1e-1 -7 2 0.5 0.5 +4\r\n0 0 0 1\r\n0 0 1 9 2\r\n");
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->curves.size(), 1u);
  const Curve& curve = read->curves[0];
  ASSERT_EQ(curve.samples.size(), 3u);
  EXPECT_EQ(curve.samples[0].position, Eigen::Vector3d(4, -7, 0.1));
  EXPECT_EQ(curve.samples[2].position, Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(curve.samples[2].tangent, Eigen::Vector3d(1, 0, 0));
}

TEST(PlyLines, ReadsBothByteOrdersAlike) {
  const std::string header =
      "element vertex 2\nproperty double x\nproperty double y\n"
      "property double z\nelement edge 1\nproperty ushort vertex1\n"
      "property char vertex2\nend_header\n";
  std::string little;
  for (const double value : {0.1, 0.2, 0.3, 4.0, 5.0, 6.0}) {
    AppendLittleEndian(value, little);
  }
  std::string big;
  for (std::size_t i = 0; i < little.size(); i += 8) {
    std::string word = little.substr(i, 8);
    std::reverse(word.begin(), word.end());
    big += word;
  }
  little += std::string("\x01\x00\x00", 3);
  big += std::string("\x00\x01\x00", 3);
  const auto a = DecodePlyLines("ply\nformat binary_little_endian 1.0\n" +
                                header + little);
  const auto b =
      DecodePlyLines("ply\nformat binary_big_endian 1.0\n" + header + big);
  ASSERT_TRUE(a.ok() && b.ok());
  ExpectSameGeometry(*b, *a, 0, 0);
  EXPECT_EQ(a->curves[0].samples[0].position, Eigen::Vector3d(0.1, 0.2, 0.3));
}

TEST(PlyLines, EveryTruncationIsReportedAsDataLoss) {
  const std::string bytes = EncodedCurves(EncodePlyLines, MakeTestCurves(), "");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto read = DecodePlyLines(std::string_view(bytes).substr(0, size));
    ASSERT_EQ(read.status().code(), StatusCode::kDataLoss) << size;
  }
}

TEST(PlyLines, CountsThatTheFileCannotHoldAreRefusedUpFront) {
  const std::string xyz =
      "property float x\nproperty float y\nproperty float z\n";
  const std::string edge = "property int vertex1\nproperty int vertex2\n";
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string start =
        "ply\nformat " + std::string(format) + " 1.0\nelement vertex ";
    for (const char* count :
         {"1000000000", "18446744073709551615", "-1", "1e9", "x", ""}) {
      const auto read =
          DecodePlyLines(start + count + "\n" + xyz + "element edge 0\n" +
                         edge + "end_header\n");
      EXPECT_EQ(read.status().code(), StatusCode::kDataLoss) << count;
    }
  }
}

TEST(PlyLines, HostileContentIsReported) {
  const std::string vertices =
      "element vertex 2\nproperty float x\nproperty float y\n"
      "property float z\n";
  const std::string edges =
      "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
  const auto code = [](const std::string& bytes) {
    return DecodePlyLines(bytes).status().code();
  };
  const std::string end = "end_header\n";
  const std::string good = AsciiPly(vertices, edges) + end + "0 0 0 1 0 0 ";
  EXPECT_EQ(code(good + "0 1"), StatusCode::kOk);
  EXPECT_EQ(code(good + "0 2"), StatusCode::kDataLoss);
  EXPECT_EQ(code(good + "0 -1"), StatusCode::kDataLoss);
  EXPECT_EQ(code(good + "0 0.5"), StatusCode::kDataLoss);
  EXPECT_EQ(code(good + "0 1e300"), StatusCode::kDataLoss);
  EXPECT_EQ(code(good + "0 nan"), StatusCode::kDataLoss);
  EXPECT_EQ(code(AsciiPly(vertices, edges) + end + "0 0 inf 1 0 0 0 1"),
            StatusCode::kDataLoss);
  EXPECT_EQ(code(AsciiPly(vertices, edges) + end + "0 0 hi 1 0 0 0 1"),
            StatusCode::kDataLoss);
  EXPECT_EQ(code(AsciiPly(vertices, "") + end + "0 0 0 1 0 0"),
            StatusCode::kUnsupported);
  EXPECT_EQ(code(AsciiPly("element void 18446744073709551615\n", vertices) +
                 edges + end + "0 0 0 1 0 0 0 1"),
            StatusCode::kOk);
  EXPECT_EQ(code(AsciiPly("element list 1\nproperty list int int a\n", "") +
                 end + "-5"),
            StatusCode::kDataLoss);
  EXPECT_EQ(code(AsciiPly("element list 1\nproperty list int int a\n", "") +
                 end + "2000000000 1"),
            StatusCode::kDataLoss);
  EXPECT_EQ(code(AsciiPly("property float x\n", vertices)),
            StatusCode::kDataLoss);
  EXPECT_EQ(code("solid not ply\n"), StatusCode::kDataLoss);
}

}  // namespace
}  // namespace curvix
