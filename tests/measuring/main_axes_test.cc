// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/main_axes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;

// Edges of boxes along the columns of `frame`, with errors of `sigma` at their
// ends, and some lines along nothing.
std::vector<DirectedLine> Boxes(const Matrix3d& frame,
                                double sigma,
                                Random& random) {
  std::vector<DirectedLine> lines;
  const auto add = [&](const Vector3d& along) {
    const Vector3d start = 5 * random.NormalVector();
    lines.push_back({start + sigma * random.NormalVector(),
                     start + along + sigma * random.NormalVector(),
                     sigma * sigma * Matrix3d::Identity(),
                     sigma * sigma * Matrix3d::Identity()});
  };
  for (int i = 0; i < 30; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double sign = random.Uniform() < 0.5 ? -1 : 1;
      add(sign * random.Uniform(0.5, 3) * frame.col(axis));
    }
  }
  for (int i = 0; i < 40; ++i) {
    add(random.Uniform(0.5, 3) * random.UnitVector());
  }
  return lines;
}

// Columns: x, y, z in the model.
Matrix3d FrameOf(const MainAxes& axes) {
  return axes.axes.world_from_model.conjugate().toRotationMatrix();
}

TEST(FindMainAxes, FindsThoseOfATurnedBox) {
  double sum = 0;
  constexpr int kNumSeeds = 40;
  for (int seed = 0; seed < kNumSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Matrix3d frame = random.Rotation();
    const auto lines = Boxes(frame, 0.002, random);
    const Vector3d up = frame.col(2) + 0.2 * random.UnitVector();
    const Vector3d view = frame.col(1) + 0.2 * random.UnitVector();
    const auto axes = FindMainAxes(lines, up, view);
    ASSERT_TRUE(axes.ok()) << axes.status().message();
    const Eigen::AngleAxisd turn(Matrix3d(FrameOf(*axes).transpose() * frame));
    EXPECT_LT(turn.angle(), 0.1 * 3.14159 / 180) << seed;
    const Vector3d error = turn.angle() * turn.axis();
    sum += error.dot(axes->axes.covariance.inverse() * error) / 3;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      EXPECT_GE(axes->num_lines[k], 30);
      EXPECT_NEAR(axes->angle_deg[k], 90, 5 * axes->angle_sigma_deg[k]);
    }
  }
  EXPECT_LT(sum / kNumSeeds, 1.5);
  EXPECT_GT(sum / kNumSeeds, 0.2);
}

TEST(FindMainAxes, TurnsWithTheModel) {
  Random random(7);
  const auto lines = Boxes(Matrix3d::Identity(), 0.002, random);
  const Matrix3d turn = random.Rotation();
  std::vector<DirectedLine> turned;
  for (const DirectedLine& line : lines) {
    turned.push_back({3 * (turn * line.start),
                      3 * (turn * line.end),
                      9 * turn * line.start_covariance * turn.transpose(),
                      9 * turn * line.end_covariance * turn.transpose()});
  }
  const Vector3d up(0.1, 0.1, 1), view(0, 1, -0.1);
  const auto one = FindMainAxes(lines, up, view);
  const auto two = FindMainAxes(turned, turn * up, turn * view);
  ASSERT_TRUE(one.ok() && two.ok());
  EXPECT_LT((turn * FrameOf(*one) - FrameOf(*two)).norm(), 1e-9);
}

TEST(FindMainAxes, UpDecidesWhichAxisIsUp) {
  Random random(8);
  const auto lines = Boxes(Matrix3d::Identity(), 0.001, random);
  for (const Vector3d& up : {Vector3d(0, 0, -1), Vector3d(1, 0, 0)}) {
    const auto axes = FindMainAxes(lines, up, {0, 0, 0});
    ASSERT_TRUE(axes.ok());
    EXPECT_GT(FrameOf(*axes).col(2).dot(up), 0.999);
    EXPECT_NEAR(FrameOf(*axes).determinant(), 1, 1e-9);
  }
}

TEST(FindMainAxes, LinesOfNoKnownDirectionDoNotCount) {
  Random random(9);
  auto lines = Boxes(Matrix3d::Identity(), 0.001, random);
  const Vector3d up(0, 0, 1), view(0, 1, 0);
  const auto without = FindMainAxes(lines, up, view);
  for (int i = 0; i < 50; ++i) {
    lines.push_back({{0, 0, 0},
                     random.UnitVector(),
                     0.1 * Matrix3d::Identity(),
                     0.1 * Matrix3d::Identity()});
  }
  const auto with = FindMainAxes(lines, up, view);
  ASSERT_TRUE(with.ok() && without.ok());
  EXPECT_EQ(FrameOf(*with), FrameOf(*without));
  EXPECT_EQ(with->num_lines, without->num_lines);
}

TEST(FindMainAxes, SaysThatNoLinesArePerpendicular) {
  std::vector<DirectedLine> lines(3);
  for (DirectedLine& line : lines) line.end = {1, 0, 0};
  const auto axes = FindMainAxes(lines, {0, 0, 1}, {0, 1, 0});
  ASSERT_FALSE(axes.ok());
  EXPECT_THAT(axes.status().message(), HasSubstr("perpendicular"));
  EXPECT_FALSE(FindMainAxes({}, {0, 0, 1}, {0, 1, 0}).ok());
}

TEST(MeanUp, IsWhatTheCamerasHoldUpwards) {
  const Scene scene =
      ToScene({LookAt({5, 0, 1}, {0, 0, 0}), LookAt({-5, 0, 1}, {0, 0, 0})});
  EXPECT_GT(MeanUp(scene.views).normalized().z(), 0.999);
  EXPECT_NEAR(MeanViewDirection(scene.views).x(), 0, 1e-9);
}

}  // namespace
}  // namespace curvix
