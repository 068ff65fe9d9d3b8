// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/main_axes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "measuring/moved_curves.h"
#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;

// With an error of `sigma` at both ends.
void AddLine(const Vector3d& start,
             const Vector3d& end,
             double sigma,
             FittedCurves& fitted) {
  CurveFit line;
  line.start = start;
  line.end = end;
  line.start_covariance = line.end_covariance =
      sigma * sigma * Matrix3d::Identity();
  fitted.curves.push_back({{line}});
}

// A circle around an axis that is known to `axis_sigma`.
void AddCircle(const Vector3d& center,
               const Matrix3d& frame,
               double radius,
               double axis_sigma,
               FittedCurves& fitted) {
  CurveFit circle;
  circle.kind = FitKind::kArc;
  circle.closed = true;
  circle.center = center;
  circle.major = radius * frame.col(0);
  circle.minor = radius * frame.col(1);
  circle.end_angle = 2 * kPi;
  circle.radius_sigma = 1e-3 * radius;
  circle.arc_covariance.block<3, 3>(3, 3) =
      axis_sigma * axis_sigma *
      (Matrix3d::Identity() - frame.col(2) * frame.col(2).transpose());
  fitted.curves.push_back({{circle}});
}

// Edges of boxes along the columns of `frame`, with errors of `sigma` at their
// ends, and some lines along nothing.
FittedCurves Boxes(const Matrix3d& frame, double sigma, Random& random) {
  FittedCurves lines;
  const auto add = [&](const Vector3d& along) {
    const Vector3d start = 5 * random.NormalVector();
    AddLine(start + sigma * random.NormalVector(),
            start + along + sigma * random.NormalVector(),
            sigma,
            lines);
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
      EXPECT_GE(axes->num_directions[k], 30);
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
  const FittedCurves turned =
      MoveFits({3, Eigen::Quaterniond(turn), {1, 2, 3}}, lines);
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
    AddLine({0, 0, 0}, random.UnitVector(), std::sqrt(0.1), lines);
  }
  const auto with = FindMainAxes(lines, up, view);
  ASSERT_TRUE(with.ok() && without.ok());
  EXPECT_EQ(FrameOf(*with), FrameOf(*without));
  EXPECT_EQ(with->num_directions, without->num_directions);
}

TEST(FindMainAxes, ManyShortLinesCountMoreThanTwoLongOnes) {
  Random random(11);
  const Matrix3d decoy = random.Rotation();
  FittedCurves lines;
  for (int i = 0; i < 2; ++i) {
    AddLine({0, 0, 0}, 10 * decoy.col(i), 1e-3, lines);
  }
  for (int i = 0; i < 30; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d start = random.UnitVector();
      AddLine(start, start + 0.5 * Vector3d::Unit(axis), 1e-3, lines);
    }
  }
  const auto axes = FindMainAxes(lines, {0, 0, 1}, {0, 1, 0});
  ASSERT_TRUE(axes.ok()) << axes.status().message();
  EXPECT_LT((FrameOf(*axes).cwiseAbs() - Matrix3d::Identity()).norm(), 1e-3);
}

// A turned part with a ring of six holes, and a short line across nothing.
TEST(FindMainAxes, FlangesHaveAnAxisAndRowsOfHoles) {
  Random random(10);
  const Matrix3d frame = random.Rotation();
  FittedCurves flange;
  for (const double radius : {5.0, 4.0, 2.0}) {
    AddCircle(radius * frame.col(2), frame, radius, 1e-3, flange);
  }
  for (int i = 0; i < 6; ++i) {
    const double angle = kPi / 3 * i;
    const Vector3d center =
        frame * Vector3d(4.5 * std::cos(angle), 4.5 * std::sin(angle), 0);
    AddCircle(center, frame, 0.3, 1e-2, flange);
    AddCircle(center + 0.4 * frame.col(2), frame, 0.3, 1e-2, flange);
  }
  AddLine({0, 0, 0}, random.UnitVector(), 1e-3, flange);
  const auto axes = FindMainAxes(flange, frame.col(2), {0, 0, 0});
  ASSERT_TRUE(axes.ok()) << axes.status().message();
  const Matrix3d found = frame.transpose() * FrameOf(*axes);
  EXPECT_LT((found.col(2) - Vector3d::UnitZ()).norm(), 1e-9);
  // x is along a side of the hexagon, or across one.
  const double turn = std::atan2(found(1, 0), found(0, 0)) / (kPi / 6);
  EXPECT_NEAR(turn, std::round(turn), 1e-6);
  EXPECT_EQ(axes->num_directions[2], 15);
}

TEST(FindMainAxes, SaysThatNothingIsPerpendicular) {
  FittedCurves lines;
  for (int i = 0; i < 3; ++i) AddLine({0, 0, 0}, {1, 0, 0}, 0, lines);
  const auto axes = FindMainAxes(lines, {0, 0, 1}, {0, 1, 0});
  ASSERT_FALSE(axes.ok());
  EXPECT_THAT(axes.status().message(), HasSubstr("perpendicular"));
  EXPECT_FALSE(FindMainAxes({}, {0, 0, 1}, {0, 1, 0}).ok());
}

TEST(FindMainAxes, SaysThatDirectionsAreNotKnown) {
  FittedCurves lines;
  AddLine({0, 0, 0}, {1, 0, 0}, 0, lines);
  for (int i = 0; i < 3; ++i) AddLine({0, 0, 0}, {0, 1, 0}, 0.1, lines);
  const auto axes = FindMainAxes(lines, {0, 0, 1}, {0, 1, 0});
  ASSERT_FALSE(axes.ok());
  EXPECT_THAT(axes.status().message(),
              AllOf(HasSubstr("(1 in all) are perpendicular"),
                    HasSubstr("3 more are not used"),
                    HasSubstr("above 1.5 degrees")));
}

TEST(MeanUp, IsWhatTheCamerasHoldUpwards) {
  const Scene scene =
      ToScene({LookAt({5, 0, 1}, {0, 0, 0}), LookAt({-5, 0, 1}, {0, 0, 0})});
  EXPECT_GT(MeanUp(scene.views).normalized().z(), 0.999);
  EXPECT_NEAR(MeanViewDirection(scene.views).x(), 0, 1e-9);
}

}  // namespace
}  // namespace curvix
