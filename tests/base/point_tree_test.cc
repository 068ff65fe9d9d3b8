// SPDX-License-Identifier: BSD-3-Clause
#include "base/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <random>
#include <vector>

namespace curvix {
namespace {

TEST(PointTree, FindsWhatASearchOfAllPointsFinds) {
  std::mt19937 bits(1);
  const auto coordinate = [&] { return static_cast<double>(bits() % 20); };
  std::vector<Eigen::Vector3d> points(500);  // with repeats
  for (auto& p : points) p = {coordinate(), coordinate(), coordinate() / 10};
  const PointTree tree(points);
  for (const double radius : {0.0, 1.0, 3.5, 100.0}) {
    for (std::size_t i = 0; i < points.size(); i += 50) {
      std::vector<std::size_t> expected;
      for (std::size_t j = 0; j < points.size(); ++j) {
        if ((points[j] - points[i]).norm() <= radius) expected.push_back(j);
      }
      EXPECT_EQ(tree.Within(points[i], radius), expected);
    }
  }
}

TEST(PointTree, TakesNoPointsAndManyInOnePlace) {
  EXPECT_TRUE(PointTree({}).Within({0, 0, 0}, 1).empty());
  const PointTree heap(
      std::vector<Eigen::Vector3d>(1000, Eigen::Vector3d::Ones()));
  EXPECT_EQ(heap.Within({1, 1, 1}, 0).size(), 1000u);
}

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

TEST(PointTree, AgreesWithExhaustiveSearch) {
  const Points points = RandomPoints(500, 1);
  const PointTree tree(points);
  for (const Eigen::Vector3d& query : RandomPoints(200, 2)) {
    double least = 10;
    std::vector<std::size_t> within;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double distance = (points[i] - query).norm();
      least = std::min(least, distance);
      if (distance <= 0.2) within.push_back(i);
    }
    const PointTree::Neighbor nearest = tree.Nearest(query);
    EXPECT_NEAR(nearest.distance, least, 1e-12);
    EXPECT_NEAR((points[nearest.index] - query).norm(), least, 1e-12);
    EXPECT_EQ(tree.Within(query, 0.2), within);
  }
}

TEST(PointTree, TheRadiusItselfIsWithin) {
  const PointTree tree({{0, 0, 0}, {0.25, 0, 0}, {0.5, 0, 0}, {5, 0, 0}});
  EXPECT_EQ(tree.Within({0, 0, 0}, 0.5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(tree.Within({5, 0, 0}, 0), (std::vector<std::size_t>{3}));
  EXPECT_TRUE(tree.Within({9, 0, 0}, 1).empty());
}

TEST(PointTree, FindsFarPoints) {
  const PointTree tree(Points(100, Eigen::Vector3d(1, 2, 3)));
  EXPECT_NEAR(tree.Nearest({1e9, 2, 3}).distance, 1e9 - 1, 1e-3);
}

}  // namespace
}  // namespace curvix
