// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_search_estimates.h"

#include <gtest/gtest.h>

#include "geometry/directions.h"
#include "tests/support/random.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

// Places around the origin and what each of six views saw of them before the
// world was `moved`.
std::vector<SeenPlace> PlacesMovedBy(const Similarity3& moved,
                                     const std::vector<PosedView>& views) {
  Random random(2);
  std::vector<SeenPlace> places;
  for (std::size_t i = 0; i < 60; ++i) {
    const Eigen::Vector3d x = random.UnitVector();
    const std::size_t view_idx = i % views.size();
    const PosedView& view = views[view_idx];
    places.push_back({view_idx, moved * x, view.Pixel(view.InCamera(x))});
  }
  return places;
}

Similarity3 SmallMove() {
  return {1.01,
          RotationBy(0.02 * Eigen::Vector3d(1, 2, 3).normalized()),
          {0.03, -0.02, 0.01}};
}

void ExpectUndone(const Similarity3& found,
                  const Similarity3& moved,
                  double tolerance) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d x = Eigen::Vector3d::Unit(axis);
    EXPECT_LT((found * (moved * x) - x).norm(), tolerance);
  }
}

TEST(FixGauge, FindsHowTheWorldMoved) {
  const std::vector<PosedView> views = RingOfViews(6);
  const Similarity3 moved = SmallMove();
  ExpectUndone(FixGauge(views, PlacesMovedBy(moved, views)), moved, 1e-9);
}

// Where rays are nearly parallel, depth is anything.
TEST(FixGauge, OnePlaceFarAwayMakesNoDifference) {
  const std::vector<PosedView> views = RingOfViews(6);
  const Similarity3 moved = SmallMove();
  std::vector<SeenPlace> places = PlacesMovedBy(moved, views);
  const Eigen::Vector3d ahead = views[0].rotation.row(2);
  places.push_back({0, 1e12 * ahead, {400, 400}});
  ExpectUndone(FixGauge(views, places), moved, 2e-3);
}

TEST(FixGauge, LeavesItWithoutPlaces) {
  EXPECT_EQ(FixGauge({}, {}).translation, Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace curvix
