// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Scenes that one walks through.
#include "synthetic/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/angles.h"
#include "synthetic/camera_rig.h"
#include "synthetic/counter_random.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// In the room's own unit, its length.
constexpr double kRoomWidth = 0.8;
constexpr double kRoomHeight = 0.5;
constexpr double kWallThickness = 0.06;

// A top on four legs, which stand on the floor at z = 0.
void AddDesk(const Vector3d& low,
             const Vector3d& high,
             std::vector<SolidPrimitive>& parts) {
  constexpr double kTopHeight = 0.02;
  constexpr double kLegWidth = 0.025;
  const double under = high.z() - kTopHeight;
  parts.push_back(
      Painted(SurfacePattern::kWood, Box({low.x(), low.y(), under}, high)));
  for (const double x : {low.x(), high.x() - kLegWidth}) {
    for (const double y : {low.y(), high.y() - kLegWidth}) {
      parts.push_back(
          Box({x, y, -0.01}, {x + kLegWidth, y + kLegWidth, under + 0.01}));
    }
  }
}

// In heights of the facade.
constexpr double kBayWidth = 0.6;
constexpr double kLengthPerView = 0.06;
constexpr double kStreetWidth = 1.5;

int NumBays(int num_views) {
  return std::max(
      2, static_cast<int>(std::lround(num_views * kLengthPerView / kBayWidth)));
}

double Length(int num_views) { return kBayWidth * NumBays(num_views); }

SolidPrimitive Recess(const Vector3d& low, const Vector3d& high) {
  return Without(Box(low, high), kHoleAlbedo);
}

// From y = `front` to y = `back`, further into the wall.
SolidPrimitive Disc(
    double x, double z, double radius, double front, double back) {
  return Cylinder({x, front, z}, {0, back - front, 0}, radius);
}

// The bay that begins at x.
void AddBay(int bay_idx, double x, std::vector<SolidPrimitive>& parts) {
  constexpr double kBefore = -0.2;  // so that no two faces coincide
  // Upstairs: a window; every third is lower.
  const double top = bay_idx % 3 == 2 ? 0.8 : 0.86;
  parts.push_back(Recess({x + 0.18, kBefore, 0.62}, {x + 0.42, 0.05, top}));
  // Downstairs: a door, a round window or a boss.
  switch (bay_idx % 3) {
    case 0:
      parts.push_back(Recess({x + 0.2, kBefore, 0.12}, {x + 0.4, 0.06, 0.42}));
      return;
    case 1:
      parts.push_back(
          Without(Disc(x + 0.3, 0.29, 0.12, kBefore, 0.05), kHoleAlbedo));
      return;
    default:
      parts.push_back(Disc(x + 0.3, 0.29, 0.11, -0.05, 0.01));
      return;
  }
}

}  // namespace

std::vector<SolidPrimitive> Room() {
  const Vector3d size(1, kRoomWidth, kRoomHeight);
  const Vector3d wall = Vector3d::Constant(kWallThickness);
  const double beyond = kWallThickness + kCutMargin;
  std::vector<SolidPrimitive> parts = {
      Box(-wall, size + wall),
      Without(Box({0, 0, 0}, size)),
      // Doorway, window and its bars, and what is in the walls.
      Without(Box({0.1, -beyond, -0.01}, {0.28, 0.05, 0.38})),
      Without(Box({0.95, 0.2, 0.16}, {1 + beyond, 0.6, 0.4})),
      Box({1.02, 0.39, 0.15}, {1.04, 0.41, 0.41}),
      Box({1.02, 0.19, 0.29}, {1.04, 0.61, 0.31}),
      Without(
          Box({0.55, kRoomWidth - 0.05, 0.2}, {0.85, kRoomWidth + 0.04, 0.3})),
      // Chimney, window board, shelf with books.
      Painted(SurfacePattern::kBrick,
              Box({0.1, kRoomWidth - 0.1, -0.01},
                  {0.35, kRoomWidth + 0.01, kRoomHeight + 0.01})),
      Box({0.94, 0.17, 0.135}, {1.01, 0.63, 0.15}),
      Painted(SurfacePattern::kWood,
              Box({-0.01, 0.2, 0.3}, {0.07, 0.6, 0.315})),
      Box({0.005, 0.25, 0.31}, {0.06, 0.27, 0.38}),
      Painted(SurfacePattern::kPrint,
              Box({0.005, 0.29, 0.31}, {0.055, 0.35, 0.4})),
      Box({0.005, 0.5, 0.31}, {0.05, 0.56, 0.36}),
      // Pictures on the walls.
      Painted(SurfacePattern::kPrint,
              Box({0.4, -0.005, 0.2}, {0.6, 0.012, 0.35})),
      Painted(SurfacePattern::kPrint,
              Box({-0.005, 0.3, 0.1}, {0.012, 0.5, 0.22})),
      Turned(15, Box({0.72, 0.1, -0.01}, {0.86, 0.24, 0.12})),
      Cylinder({0.15, 0.55, -0.01}, {0, 0, 0.16}, 0.05)};
  AddDesk({0.55, 0.5, 0}, {0.9, 0.7, 0.14}, parts);
  parts.push_back(Cylinder({0.8, 0.6, 0.13}, {0, 0, 0.07}, 0.025));
  parts.push_back(Turned(20,
                         Painted(SurfacePattern::kPrint,
                                 Box({0.6, 0.56, 0.13}, {0.7, 0.62, 0.16}))));
  return parts;
}

std::vector<Rigid3> MakeRoomPoses(int num_views,
                                  double length,
                                  std::uint64_t seed) {
  const double golden_angle = kPi * (3 - std::sqrt(5.0));
  const double unit = length / (1 + 2 * kWallThickness);
  std::vector<Rigid3> poses;
  for (int i = 0; i < num_views; ++i) {
    const std::uint64_t view_seed = Mix(seed, static_cast<std::uint64_t>(i));
    std::uint64_t counter = 0;
    const auto next = [&] { return Uniform(Mix(view_seed, counter++)) - 0.5; };
    const double turn = golden_angle * i;
    const Vector3d towards(std::cos(turn), kRoomWidth * std::sin(turn), 0);
    const double eye_level = 0.04 + 0.2 * next();
    const double x = 0.2 * next();
    const double y = 0.2 * next();
    const double z = 0.25 * next() - 0.03;
    const Vector3d centre = 0.32 * towards + Vector3d(0, 0, eye_level);
    const Vector3d target = -0.4 * towards + Vector3d(x, y, z);
    poses.push_back(LookingAt(unit * centre, unit * target));
  }
  return poses;
}

std::vector<SolidPrimitive> Facade(int num_views) {
  const double length = Length(num_views);
  std::vector<SolidPrimitive> parts = {Box({0, 0, 0}, {length, 0.12, 1})};
  for (int i = 0; i < NumBays(num_views); ++i) AddBay(i, i * kBayWidth, parts);
  for (const auto& [low, high, out] :
       {std::array{0.0, 0.07, 0.05}, std::array{0.93, 1.0, 0.06}}) {
    parts.push_back(Box({0, -out, low}, {length, 0.01, high}));
  }
  return parts;
}

std::vector<Rigid3> MakeStreetPoses(int num_views,
                                    double height,
                                    std::uint64_t seed) {
  // Many heights: horizontal edges have depth from these alone.
  constexpr double kHighest = 0.5;
  constexpr int kNumHeights = 7;
  constexpr std::array kAhead = {-0.35, 0.0, 0.35};  // tangents of angles
  const double length = Length(num_views);
  const int num_places = (num_views + 1) / 2;
  std::vector<Rigid3> poses;
  for (int i = 0; i < num_views; ++i) {
    const int place = i / 2;
    const std::uint64_t view_seed = Mix(seed, static_cast<std::uint64_t>(i));
    std::uint64_t counter = 0;
    const auto next = [&] { return Uniform(Mix(view_seed, counter++)) - 0.5; };
    const double x = length * ((place + 0.5 + 0.5 * next()) / num_places - 0.5);
    const double distance = kStreetWidth * (1 + 0.1 * next());
    const double z =
        kHighest * (2.0 * ((i * 3) % kNumHeights) / (kNumHeights - 1) - 1) +
        0.1 * next();
    const double ahead =
        kAhead[static_cast<std::size_t>(place % 3)] + 0.1 * next();
    const Vector3d target(x + ahead * distance, 0, 0.05 * next());
    poses.push_back(
        LookingAt(height * Vector3d(x, -distance, z), height * target));
  }
  return poses;
}

}  // namespace curvix
