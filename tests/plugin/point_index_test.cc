// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/point_index.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace curvix {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points RandomPoints(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  Points points(count);
  for (Eigen::Vector3d& point : points) {
    for (int i = 0; i < 3; ++i) {
      point[i] = static_cast<double>(generator()) / 4294967296.0;
    }
  }
  return points;
}

TEST(PointIndex, AgreesWithExhaustiveSearch) {
  const Points points = RandomPoints(500, 1);
  const PointIndex index(points);
  for (const Eigen::Vector3d& query : RandomPoints(200, 2)) {
    double least = 10;
    std::vector<std::size_t> within;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double distance = (points[i] - query).norm();
      least = std::min(least, distance);
      if (distance <= 0.2) within.push_back(i);
    }
    const PointIndex::Neighbor nearest = index.Nearest(query);
    EXPECT_NEAR(nearest.distance, least, 1e-12);
    EXPECT_NEAR((points[nearest.index] - query).norm(), least, 1e-12);
    EXPECT_EQ(index.Within(query, 0.2), within);
  }
}

TEST(PointIndex, TheRadiusItselfIsWithin) {
  const PointIndex index({{0, 0, 0}, {0.25, 0, 0}, {0.5, 0, 0}, {5, 0, 0}});
  EXPECT_EQ(index.Within({0, 0, 0}, 0.5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(index.Within({5, 0, 0}, 0), (std::vector<std::size_t>{3}));
  EXPECT_TRUE(index.Within({9, 0, 0}, 1).empty());
}

TEST(PointIndex, FindsFarPointsAndRepeatedOnes) {
  const PointIndex index(Points(100, Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(index.Within({1, 2, 3}, 0).size(), 100u);
  EXPECT_NEAR(index.Nearest({1e9, 2, 3}).distance, 1e9 - 1, 1e-3);
}

}  // namespace
}  // namespace curvix
