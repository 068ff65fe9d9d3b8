// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/surfaces.h"

#include "base/angles.h"
#include "geometry/directions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvix {
namespace {

constexpr double kFocal = 100;
constexpr double kDistance = 10;  // from the camera to the plane z = 0

// 64 x 32 pixels.
Camera SmallCamera() {
  return {CameraModel::kPinhole, 64, 32, {kFocal, kFocal, 32, 16}};
}

// Looks along +z from z = -10.
Rigid3 FromTheFront() {
  Rigid3 pose;
  pose.translation.z() = kDistance;
  return pose;
}

GrayImage RenderPlain(const Solid& solid, const Rigid3& pose) {
  return Render(solid, Surfaces(solid, {}), SmallCamera(), pose);
}

double SumOfRow(const GrayImage& image, int row) {
  double sum = 0;
  for (int column = 0; column < image.width; ++column) {
    sum += static_cast<double>(image.at(column, row));
  }
  return sum;
}

// A wide box behind the plane z = 0, its right side through (x, 0) and turned
// by `angle` in the image.
Solid WallUpTo(double x, double angle) {
  SolidPrimitive box;
  box.size = {20, 20, 1};
  box.world_from_own.rotation =
      Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d normal =
      box.world_from_own.rotation * Eigen::Vector3d::UnitX();
  box.world_from_own.translation =
      Eigen::Vector3d(x, 0, 1) - box.size.x() * normal;
  return Solid({box});
}

TEST(RenderTest, PixelsOnAStraightEdgeAddUpToItsExactPosition) {
  for (int shift = 0; shift < 23; ++shift) {
    for (const double degrees : {0.0, 1.0, 7.0, 30.0, -42.0}) {
      const double x = 0.6 + 0.0137 * shift;
      const double angle = DegToRad(degrees);
      const GrayImage image = RenderPlain(WallUpTo(x, angle), FromTheFront());
      const double face = static_cast<double>(image.at(0, 16));
      const double behind = static_cast<double>(image.at(63, 16));
      for (int row = 8; row < 24; ++row) {
        const double covered =
            (SumOfRow(image, row) - image.width * behind) / (face - behind);
        const double exact =
            32 + kFocal * x / kDistance - std::tan(angle) * (row + 0.5 - 16);
        EXPECT_NEAR(covered, exact, 0.005) << degrees << " deg, row " << row;
      }
    }
  }
}

TEST(RenderTest, PixelsOfADiscAddUpToItsExactArea) {
  SolidPrimitive disc;  // widens away from its face: the side is out of sight
  disc.shape = PrimitiveShape::kFrustum;
  disc.size = {1.2345, 0.1, 2};
  disc.world_from_own.translation = {0.031, -0.017, 0};
  const GrayImage image = RenderPlain(Solid({disc}), FromTheFront());
  const double face = static_cast<double>(image.at(32, 16));
  const double behind = static_cast<double>(image.at(0, 0));
  double area = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double share =
          (static_cast<double>(image.at(x, y)) - behind) / (face - behind);
      area += share;
      moment += share * Eigen::Vector2d(x + 0.5, y + 0.5);
    }
  }
  const double radius = kFocal * 1.2345 / kDistance;
  EXPECT_NEAR(area / (kPi * radius * radius), 1, 1e-3);
  EXPECT_NEAR(moment.x() / area, 32.31, 0.005);
  EXPECT_NEAR(moment.y() / area, 15.83, 0.005);
}

TEST(RenderTest, NeighbouringFacesOfABoxDifferByTwentyGreyLevels) {
  SolidPrimitive box;
  box.size = {1, 1, 1};
  const Solid solid({box});
  std::vector<double> greys;
  for (int side = 0; side < 6; ++side) {
    const Eigen::Vector3d eye =
        (side % 2 == 0 ? 10 : -10) * Eigen::Vector3d::Unit(side / 2);
    Rigid3 pose;
    pose.rotation = ShortestRotation(-eye, Eigen::Vector3d::UnitZ());
    pose.translation = -(pose.rotation * eye);
    const GrayImage image = RenderPlain(solid, pose);
    greys.push_back(static_cast<double>(image.at(32, 16)));
    greys.push_back(static_cast<double>(image.at(0, 0)));
  }
  for (std::size_t i = 0; i < greys.size(); i += 2) {
    EXPECT_GT(std::abs(greys[i] - greys[i + 1]), 20);  // from the background
    for (std::size_t j = 0; j < i; j += 2) {
      EXPECT_GT(std::abs(greys[i] - greys[j]), 20);
    }
  }
}

TEST(RenderTest, TextureStaysWithinItsContrast) {
  const Solid wall = WallUpTo(15, 0);
  const GrayImage plain = RenderPlain(wall, FromTheFront());
  const GrayImage textured =
      Render(wall,
             Surfaces(wall, {.texture = 40, .scale = 9, .seed = 7}),
             SmallCamera(),
             FromTheFront());
  float lowest = 0;
  float highest = 0;
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
    lowest = std::min(lowest, textured.pixels[i] - plain.pixels[i]);
    highest = std::max(highest, textured.pixels[i] - plain.pixels[i]);
  }
  EXPECT_GE(lowest, -20.001F);
  EXPECT_LE(highest, 20.001F);
  EXPECT_GT(highest - lowest, 20.0F);
}

TEST(RenderTest, LampsOnlyBrightenAndMoveWithTheView) {
  SolidPrimitive ball;
  ball.shape = PrimitiveShape::kSphere;
  ball.size.setConstant(1);
  const Solid solid({ball});
  const Surfaces shiny(solid, {.reflections = true});
  // The mean pixel of the lamps, from two places beside each other.
  const auto lamps = [&](double turn) {
    Rigid3 pose = FromTheFront();
    pose.rotation = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY());
    const GrayImage image = Render(solid, shiny, SmallCamera(), pose);
    const GrayImage plain = RenderPlain(solid, pose);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const float change = image.at(x, y) - plain.at(x, y);
        EXPECT_GE(change, -2);  // areas are measured to 1/100
        if (change > 5) sum += Eigen::Vector3d(x, y, 1);
      }
    }
    return sum;
  };
  const Eigen::Vector3d straight = lamps(0);
  const Eigen::Vector3d turned = lamps(0.3);
  ASSERT_GT(straight.z(), 5);
  ASSERT_GT(turned.z(), 5);
  // A mark on the front of the ball would move by a sixth of the ball's radius.
  const double move = (turned.hnormalized() - straight.hnormalized()).norm();
  EXPECT_GT(move, 0.2);
}

}  // namespace
}  // namespace curvix
