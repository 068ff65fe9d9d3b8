// SPDX-License-Identifier: BSD-3-Clause
// The occluding contours of smooth bodies look like edges in every image and
// are none.
#include <curvix/reconstruct.h>
#include <curvix/refine_poses.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "model/posed_view.h"
#include "tests/support/wire_scene.h"

namespace curvix {
namespace {

constexpr double kHalfHeight = 0.8;

struct UprightCylinder {
  double radius = 0;
  Eigen::Vector2d axis = Eigen::Vector2d::Zero();
};

// Seen from `center`: the two lines at which rays touch the cylinder.
std::vector<TestCurve> Outline(const Eigen::Vector3d& center,
                               const UprightCylinder& cylinder) {
  const double radius = cylinder.radius;
  const Eigen::Vector2d ray = center.head<2>() - cylinder.axis;
  const double towards = std::atan2(ray.y(), ray.x());
  const double turn = std::acos(radius / ray.norm());
  std::vector<TestCurve> lines;
  for (const double angle : {towards - turn, towards + turn}) {
    const Eigen::Vector3d foot(cylinder.axis.x() + radius * std::cos(angle),
                               cylinder.axis.y() + radius * std::sin(angle),
                               -kHalfHeight);
    lines.push_back(
        LineCurve(foot, foot + Eigen::Vector3d(0, 0, 2 * kHalfHeight)));
  }
  return lines;
}

// A cylinder whose occluding contours and outlines show in all views.
WireScene Cylinder(double radius, int num_views) {
  WireScene made = MakeWireScene({CircleCurve({0, 0, kHalfHeight}, radius),
                                  CircleCurve({0, 0, -kHalfHeight}, radius)},
                                 num_views);
  const std::vector<PosedView> views = MakePosedViews(made.scene);
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<TestCurve> shown = made.truth;
    for (TestCurve& line : Outline(views[i].center, {radius})) {
      shown.push_back(std::move(line));
    }
    made.edge_maps[i] = ExactEdgeMaps(shown, {views[i]}, 30).front();
  }
  return made;
}

class OccludingContours : public testing::TestWithParam<double> {};

TEST_P(OccludingContours, AreLeftOutAndRimsStay) {
  const WireScene cylinder = Cylinder(GetParam(), 30);
  const auto result =
      ReconstructCurves(cylinder.scene, cylinder.edge_maps, Options());
  ASSERT_TRUE(result.ok()) << result.status().message();
  const WireAgreement agreement =
      Compare(result->curves, cylinder.truth, kWirePx);
  EXPECT_GT(agreement.accurate, 0.99);
  EXPECT_GT(agreement.found, 0.98);
}

// Radii of 13, 32 and 65 pixels.
INSTANTIATE_TEST_SUITE_P(Radii,
                         OccludingContours,
                         testing::Values(0.2, 0.5, 1.0));

// Outlines alone: nothing in the scene keeps its place. Taken for edges, they
// lie 0.19 px off with true poses.
TEST(OccludingContours, DoNotBendTruePoses) {
  WireScene made = MakeWireScene({}, 24);
  const std::vector<PosedView> views = MakePosedViews(made.scene);
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<TestCurve> shown;
    for (int k = 0; k < 6; ++k) {
      const UprightCylinder cylinder = {0.1 + 0.05 * k,
                                        {0.7 * std::cos(k), 0.7 * std::sin(k)}};
      for (TestCurve& line : Outline(views[i].center, cylinder)) {
        shown.push_back(std::move(line));
      }
    }
    made.edge_maps[i] = ExactEdgeMaps(shown, {views[i]}, 30).front();
  }
  const auto refined =
      RefinePosesWithCurves(made.scene, made.edge_maps, Options());
  ASSERT_TRUE(refined.ok()) << refined.status().message();
  EXPECT_FALSE(refined->accepted);
  EXPECT_GT(refined->num_check_observations, 100u);
  EXPECT_LT(refined->before.median_px, 0.08);
}

TEST(KeptOccludingContours, AreLabelled) {
  const WireScene cylinder = Cylinder(0.2, 30);
  Options options;
  options.curve_refinement.keep_occluding_contours = true;
  const auto result =
      ReconstructCurves(cylinder.scene, cylinder.edge_maps, options);
  ASSERT_TRUE(result.ok()) << result.status().message();
  CurveSet edges, contours;
  for (const Curve& curve : result->curves.curves) {
    (MainKind(curve) == CurveKind::kOccludingContour ? contours : edges)
        .curves.push_back(curve);
  }
  EXPECT_GT(Compare(edges, cylinder.truth, kWirePx).accurate, 0.99);
  EXPECT_FALSE(contours.curves.empty());
  for (const Curve& contour : contours.curves) {
    for (const CurveSample& sample : contour.samples) {
      EXPECT_GT(std::abs(sample.tangent.z()), 0.9);
    }
  }
}

}  // namespace
}  // namespace curvix
