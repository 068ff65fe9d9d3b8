// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/moved_curves.h"

#include <cmath>

#include "gtest/gtest.h"
#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

Similarity3 SomeSimilarity() {
  Random random(2);
  return {3.5, Eigen::Quaterniond(random.Rotation()), Vector3d(1, -2, 7)};
}

// An L of two straight curves that meet, and a circle.
CurveSet SomeCurves() {
  Random random(3);
  CurveSet set;
  set.curves.resize(3);
  for (int i = 0; i <= 100; ++i) {
    const double t = i / 100.0;
    const Vector3d points[] = {
        Vector3d(t, 0, 0),
        Vector3d(1, t, 0),
        Vector3d(std::cos(0.06 * i), 2 + std::sin(0.06 * i), 0.5)};
    for (std::size_t c = 0; c < 3; ++c) {
      CurveSample& s = set.curves[c].samples.emplace_back();
      s.tangent = c == 0 ? Vector3d::UnitX() : Vector3d::UnitY();
      s.position = points[c];
      if (c == 2) s.tangent = {-std::sin(0.06 * i), std::cos(0.06 * i), 0};
      const bool meets = (c == 0 && i == 100) || (c == 1 && i == 0);
      if (!meets) s.position += 0.001 * random.Across(s.tangent);
      s.sigma = 0.001;
      s.covariance = 1e-6 * (Eigen::Matrix3d::Identity() -
                             s.tangent * s.tangent.transpose());
    }
  }
  return set;
}

TEST(MovedCurves, FitsOfMovedCurvesAreMovedFits) {
  const Similarity3 s = SomeSimilarity();
  const CurveSet curves = SomeCurves();
  CurveSet moved;
  MovedCurves(CurvesInMemory(curves), s)
      .ForEach([&](std::size_t, const Curve& c) { moved.curves.push_back(c); });
  const FittedCurves one = MoveFits(s, FitCurves(curves, {}, {}, 1));
  const FittedCurves two = FitCurves(moved, {}, {}, 1);
  ASSERT_EQ(one.nodes.size(), two.nodes.size());
  ASSERT_GE(one.nodes.size(), 1u);
  for (std::size_t i = 0; i < one.nodes.size(); ++i) {
    EXPECT_LT((one.nodes[i].position - two.nodes[i].position).norm(), 1e-9);
    const double size = two.nodes[i].covariance.norm();
    EXPECT_GT(size, 0);
    EXPECT_LT((one.nodes[i].covariance - two.nodes[i].covariance).norm(),
              1e-6 * size);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    ASSERT_EQ(one.curves[c].fits.size(), two.curves[c].fits.size());
    const CurveFit& a = one.curves[c].fits.front();
    const CurveFit& b = two.curves[c].fits.front();
    EXPECT_EQ(KindName(a), KindName(b));
    EXPECT_LT((a.start - b.start).norm(), 1e-8);
    EXPECT_LT((a.center - b.center).norm(), c == 2 ? 1e-8 : 1e9);
    EXPECT_NEAR(a.sigma, b.sigma, 1e-9);
    EXPECT_NEAR(a.radius_sigma, b.radius_sigma, 1e-9);
    EXPECT_NEAR(Length(a), Length(b), 1e-8);
  }
}

TEST(MovedCurves, EndsStayOnTheirNodesToTheLastBit) {
  const FittedCurves fitted =
      MoveFits(SomeSimilarity(), FitCurves(SomeCurves(), {}, {}, 1));
  int num_ends = 0;
  for (const CurveNode& node : fitted.nodes) {
    for (const CurveNode::End& end : node.ends) {
      const CurveFit& fit = fitted.curves[end.curve_idx].fits[end.fit_idx];
      EXPECT_EQ(end.at_end ? fit.end : fit.start, node.position);
      ++num_ends;
    }
  }
  EXPECT_GE(num_ends, 2);
}

TEST(MoveScene, ImagesSeeTheSame) {
  const Similarity3 s = SomeSimilarity();
  const Scene scene = ToScene({LookAt({5, 1, 1}, {0, 0, 0})});
  const Scene moved = MoveScene(s, scene);
  const Vector3d point(0.1, 0.2, -0.3);
  const auto before = ProjectPoint(point, scene.views[0], scene.cameras[0]);
  const auto after = ProjectPoint(s * point, moved.views[0], moved.cameras[0]);
  ASSERT_TRUE(before && after);
  EXPECT_LT((*before - *after).norm(), 1e-8);
}

TEST(Similarity3, InverseUndoes) {
  const Similarity3 s = SomeSimilarity();
  const Vector3d x(0.3, 4, -2);
  EXPECT_LT((s.Inverse() * (s * x) - x).norm(), 1e-12);
}

}  // namespace
}  // namespace curvix
