// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "synthetic/street.h"

#include "base/angles.h"
#include "synthetic/counter_random.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace curvix {
namespace {

using Eigen::Vector3d;

// In heights of the facade.
constexpr double kBayWidth = 0.6;
constexpr double kLengthPerView = 0.06;
constexpr double kStreetWidth = 1.5;

int NumBays(int num_views) {
  return std::max(
      2, static_cast<int>(std::lround(num_views * kLengthPerView / kBayWidth)));
}

double Length(int num_views) { return kBayWidth * NumBays(num_views); }

SolidPrimitive Block(const Vector3d& low, const Vector3d& high, bool is_added) {
  SolidPrimitive box;
  box.shape = PrimitiveShape::kBox;
  box.is_added = is_added;
  box.albedo = is_added ? 1 : 0.8;
  box.size = (high - low) / 2;
  box.world_from_own.translation = (low + high) / 2;
  return box;
}

// From y = `front` to y = `back`, further into the wall.
SolidPrimitive Round(double x,
                     double z,
                     double radius,
                     double front,
                     double back,
                     bool is_added) {
  SolidPrimitive cylinder;
  cylinder.shape = PrimitiveShape::kFrustum;
  cylinder.is_added = is_added;
  cylinder.albedo = is_added ? 1 : 0.8;
  cylinder.size = {radius, radius, back - front};
  cylinder.world_from_own = {
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::UnitY()),
      {x, front, z}};
  return cylinder;
}

// The bay that begins at x.
void AddBay(int bay_idx, double x, std::vector<SolidPrimitive>& parts) {
  constexpr double kBefore = -0.2;  // so that no two faces coincide
  // Upstairs: a window; every third is lower.
  const double top = bay_idx % 3 == 2 ? 0.8 : 0.86;
  parts.push_back(
      Block({x + 0.18, kBefore, 0.62}, {x + 0.42, 0.05, top}, false));
  // Downstairs: a door, a round window or a boss.
  switch (bay_idx % 3) {
    case 0:
      parts.push_back(
          Block({x + 0.2, kBefore, 0.12}, {x + 0.4, 0.06, 0.42}, false));
      return;
    case 1:
      parts.push_back(Round(x + 0.3, 0.29, 0.12, kBefore, 0.05, false));
      return;
    default:
      parts.push_back(Round(x + 0.3, 0.29, 0.11, -0.05, 0.01, true));
      return;
  }
}

Rigid3 LookingAt(const Vector3d& centre, const Vector3d& target) {
  const Vector3d forward = (target - centre).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d world_from_cam;
  world_from_cam << right, forward.cross(right), forward;
  Rigid3 pose;
  pose.rotation = Eigen::Quaterniond(world_from_cam.transpose()).normalized();
  pose.translation = -(pose.rotation * centre);
  return pose;
}

}  // namespace

std::vector<SolidPrimitive> Facade(int num_views) {
  const double length = Length(num_views);
  std::vector<SolidPrimitive> parts = {
      Block({0, 0, 0}, {length, 0.12, 1}, true)};
  for (int i = 0; i < NumBays(num_views); ++i) AddBay(i, i * kBayWidth, parts);
  for (const auto& [low, high, out] :
       {std::array{0.0, 0.07, 0.05}, std::array{0.93, 1.0, 0.06}}) {
    parts.push_back(Block({0, -out, low}, {length, 0.01, high}, true));
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
