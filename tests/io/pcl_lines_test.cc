// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcl_lines.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>

#include "base/file_io.h"
#include "tests/io/test_curves.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

// The samples of all curves, as PCL has them.
pcl::PointCloud<CurvePoint> PointsOf(const CurveSet& curves) {
  pcl::PointCloud<CurvePoint> cloud;
  for (std::size_t id = 0; id < curves.curves.size(); ++id) {
    for (const CurveSample& sample : curves.curves[id].samples) {
      cloud.push_back(ToPoint(sample, id));
    }
  }
  return cloud;
}

TEST(PclLines, PclReadsThePcdBackWithTheSameFields) {
  const CurveSet curves = MakeTestCurves();
  const pcl::PointCloud<CurvePoint> cloud = PointsOf(curves);
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "curves.pcd").string();
  ASSERT_TRUE(WriteFileAtomically(path, EncodedCurves(EncodePcd, curves)).ok());

  pcl::PCLPointCloud2 message;
  ASSERT_EQ(pcl::PCDReader().read(path, message), 0);
  std::string names;
  for (const auto& field : message.fields) names += field.name + " ";
  EXPECT_EQ(names, "x y z tx ty tz rgb curve_id confidence support ");
  pcl::PointCloud<CurvePoint> read;
  pcl::fromPCLPointCloud2(message, read);
  ASSERT_EQ(read.size(), 23u);
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].getVector3fMap(), cloud[i].getVector3fMap());
    EXPECT_EQ(read[i].tx, cloud[i].tx);
    EXPECT_EQ(read[i].ty, cloud[i].ty);
    EXPECT_EQ(read[i].tz, cloud[i].tz);
    EXPECT_EQ(read[i].rgba, cloud[i].rgba);
    EXPECT_EQ(read[i].curve_id, cloud[i].curve_id);
    EXPECT_EQ(read[i].confidence, cloud[i].confidence);
    EXPECT_EQ(read[i].support, cloud[i].support);
  }
  EXPECT_EQ(read[8].curve_id, 0u);
  EXPECT_EQ(read[9].curve_id, 1u);
  EXPECT_EQ(read[3].support, 3u);
  EXPECT_EQ(read[3].confidence, 3.0f / 7.0f);
}

// pcl::PCDWriter is what the bytes must agree with.
TEST(PclLines, BytesAreThoseOfPclsOwnWriter) {
  const CurveSet curves = MakeTestCurves();
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "pcl.pcd").string();
  ASSERT_EQ(pcl::PCDWriter().writeBinary(path, PointsOf(curves)), 0);
  EXPECT_EQ(*ReadFile(path), EncodedCurves(EncodePcd, curves));
}

TEST(PclLines, EmptySetIsAValidFileWithoutPoints) {
  const std::string bytes = EncodedCurves(EncodePcd, CurveSet());
  EXPECT_NE(bytes.find("POINTS 0\nDATA binary\n"), std::string::npos);
}

}  // namespace
}  // namespace curvix
