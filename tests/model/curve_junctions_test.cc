// SPDX-License-Identifier: BSD-3-Clause
#include "model/curve_chains.h"

#include <gtest/gtest.h>

namespace curvix {
namespace {

Curve Between(const Eigen::Vector3d& a,
              const Eigen::Vector3d& b,
              double sigma = 0.1) {
  Curve curve;
  for (const double share : {0.0, 0.5, 1.0}) {
    CurveSample sample;
    sample.position = (1 - share) * a + share * b;
    sample.sigma = sigma;
    curve.samples.push_back(sample);
  }
  return curve;
}

const Eigen::Vector3d kA(0.1, 0.2, 0.3), kB(1, 0, 0), kC(0, 1, 0);

TEST(IndexJunctions, EndsInOnePlaceShareAJunction) {
  CurveSet set{{Between(kB, kA), Between(kA, kC, 0.2), Between(kC, kA)}, {}};
  IndexJunctions(set);
  ASSERT_EQ(set.junctions.size(), 2u);
  EXPECT_EQ(set.junctions[0].position, kA);
  EXPECT_EQ(set.junctions[0].num_ends, 3);
  EXPECT_EQ(set.junctions[0].sigma, 0.2);
  EXPECT_EQ(set.junctions[1].position, kC);
  EXPECT_EQ(set.curves[0].start_junction, -1);
  EXPECT_EQ(set.curves[0].end_junction, 0);
  EXPECT_EQ(set.curves[1].start_junction, 0);
  EXPECT_EQ(set.curves[1].end_junction, 1);
  EXPECT_EQ(set.curves[2].start_junction, 1);
}

TEST(IndexJunctions, NearIsNotEnough) {
  CurveSet set{
      {Between(kB, kA), Between(kA + Eigen::Vector3d(1e-15, 0, 0), kC)}, {}};
  IndexJunctions(set);
  EXPECT_TRUE(set.junctions.empty());
}

TEST(IndexJunctions, ClosedCurvesHaveNone) {
  CurveSet set{{Between(kA, kB), Between(kA, kC)}, {}};
  set.curves[1].closed = true;
  set.curves[1].start_junction = 7;
  IndexJunctions(set);
  EXPECT_TRUE(set.junctions.empty());
  EXPECT_EQ(set.curves[1].start_junction, -1);
}

TEST(IndexJunctions, ACurveMayMeetItself) {
  CurveSet set{{Between(kA, kA)}, {}};
  IndexJunctions(set);
  ASSERT_EQ(set.junctions.size(), 1u);
  EXPECT_EQ(set.curves[0].start_junction, set.curves[0].end_junction);
}

}  // namespace
}  // namespace curvix
