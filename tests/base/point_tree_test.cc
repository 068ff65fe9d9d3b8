// SPDX-License-Identifier: BSD-3-Clause
#include "base/point_tree.h"

#include <gtest/gtest.h>

#include <random>

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

}  // namespace
}  // namespace curvix
