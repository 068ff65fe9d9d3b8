// SPDX-License-Identifier: BSD-3-Clause
#include "poses/gauge.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

TEST(FixGauge, FindsHowTheWorldMoved) {
  const std::vector<PosedView> views = RingOfViews(6);
  Rigid3 moved;
  moved.rotation =
      Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 2, 3).normalized());
  moved.translation = {0.03, -0.02, 0.01};
  Random random(2);
  std::vector<SeenPlace> places;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d x = random.UnitVector();
    const auto view_idx = static_cast<std::size_t>(i % 6);
    const PosedView& view = views[view_idx];
    places.push_back({view_idx, moved * x, view.Pixel(view.InCamera(x))});
  }
  const Rigid3 left = FixGauge(views, places) * moved;
  EXPECT_LT(left.translation.norm(), 1e-9);
  EXPECT_LT(left.rotation.angularDistance(Eigen::Quaterniond::Identity()),
            1e-7);
}

TEST(FixGauge, LeavesItWithoutPlaces) {
  EXPECT_EQ(FixGauge({}, {}).translation, Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace curvix
