// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/scenes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/check.h"
#include "geometry/directions.h"

namespace curvix {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr SurfacePattern kBrick = SurfacePattern::kBrick;
constexpr SurfacePattern kWood = SurfacePattern::kWood;
constexpr SurfacePattern kPrint = SurfacePattern::kPrint;

SolidPrimitive Tinted(double albedo, SolidPrimitive primitive) {
  primitive.albedo = albedo;
  return primitive;
}

// What is above a slope through `at`, which rises along `up` (unit).
SolidPrimitive AboveSlope(const Vector3d& at,
                          const Vector3d& along,
                          const Vector3d& up) {
  const Vector3d out = along.cross(up);
  SolidPrimitive box = Box({-2, -2, -1}, {2, 2, 1});
  Eigen::Matrix3d axes;
  axes << along, up, out;
  box.world_from_own = {Eigen::Quaterniond(axes).normalized(), at + out};
  return Without(box);
}

// A recess in the front wall with a cross of bars, a ledge and shutters.
void AddWindow(double x, std::vector<SolidPrimitive>& parts) {
  const double bottom = 0.2;
  const double top = 0.38;
  const double right = x + 0.18;
  parts.push_back(Without(Box({x, -0.1, bottom}, {right, 0.05, top}), 0.6));
  parts.push_back(
      Box({x + 0.08, 0.025, bottom - 0.01}, {x + 0.1, 0.06, top + 0.01}));
  parts.push_back(Box({x - 0.01, 0.025, 0.28}, {right + 0.01, 0.06, 0.3}));
  parts.push_back(Box({x - 0.03, -0.04, bottom - 0.035},
                      {right + 0.03, 0.03, bottom - 0.002}));
  // Open shutters.
  const Vector3d up(0, 0, top - bottom);
  parts.push_back(FlatSheet({x - 0.01, 0, bottom}, {-0.05, -0.09, 0}, up));
  parts.push_back(FlatSheet({right + 0.01, 0, bottom}, {0.05, -0.09, 0}, up));
}

// A body of which all edges are rounded: planes, cylinders and spheres that
// continue each other smoothly.
void AddRounded(const Vector3d& low,
                const Vector3d& high,
                double radius,
                std::vector<SolidPrimitive>& parts) {
  const Vector3d inset = Vector3d::Constant(radius);
  const Vector3d from = low + inset;
  const Vector3d to = high - inset;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d out = radius * Vector3d::Unit(axis);
    parts.push_back(Box(from - out, to + out));
    const Vector3d span = (to - from)[axis] * Vector3d::Unit(axis);
    for (int corner = 0; corner < 4; ++corner) {
      Vector3d base = from;
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      if (corner & 1) base[u] = to[u];
      if (corner & 2) base[v] = to[v];
      parts.push_back(Cylinder(base, span, radius));
    }
  }
  for (int corner = 0; corner < 8; ++corner) {
    parts.push_back(Sphere({corner & 1 ? to.x() : from.x(),
                            corner & 2 ? to.y() : from.y(),
                            corner & 4 ? to.z() : from.z()},
                           radius));
  }
}

// A neck with a ball on it, which meet where the neck ends.
void AddKnob(const Vector3d& foot,
             double neck_radius,
             double neck_height,
             double ball_radius,
             std::vector<SolidPrimitive>& parts) {
  const double sunk =
      std::sqrt(ball_radius * ball_radius - neck_radius * neck_radius);
  const Vector3d up = Vector3d::UnitZ();
  parts.push_back(
      Cylinder(foot - 0.01 * up, (neck_height + 0.01) * up, neck_radius));
  parts.push_back(Sphere(foot + (neck_height + sunk) * up, ball_radius));
}

void AddBottle(const Vector3d& foot, std::vector<SolidPrimitive>& parts) {
  const auto at = [&](double z) {
    return Vector3d(foot + z * Vector3d::UnitZ());
  };
  const auto up = [](double z) { return Vector3d(0, 0, z); };
  parts.push_back(
      Turned(-100, Painted(kPrint, Cylinder(at(-0.01), up(0.3), 0.1))));
  parts.push_back(Frustum(at(0.29), up(0.1), 0.1, 0.04));
  parts.push_back(Cylinder(at(0.38), up(0.07), 0.04));
  parts.push_back(Tinted(0.6, Cylinder(at(0.44), up(0.04), 0.047)));
}

std::vector<SolidPrimitive> Block() {
  return {Box({0, 0, 0}, {1, 0.7, 0.55}),
          Without(Box({0.55, -kCutMargin, 0.25}, {1 + kCutMargin, 0.8, 0.8}))};
}

std::vector<SolidPrimitive> UprightCylinder() {
  return {Box({-0.5, -0.5, 0}, {0.5, 0.5, 0.14}),
          Cylinder({0, 0, 0.07}, {0, 0, 0.63}, 0.28)};
}

std::vector<SolidPrimitive> Cone() {
  return {Box({-0.5, -0.4, 0}, {0.5, 0.4, 0.14}),
          Frustum({0, 0, 0.14}, {0, 0, 0.55}, 0.33, 0.14)};
}

std::vector<SolidPrimitive> CutSphere() {
  const Vector3d up = Vector3d(-0.35, -0.3, 0.9).normalized();
  SolidPrimitive cut = Box({-1, -1, 0}, {1, 1, 1});
  cut.world_from_own.rotation = ShortestRotation(Vector3d::UnitZ(), up);
  cut.world_from_own.translation = (0.22 + 0.5) * up;
  return {Sphere({0, 0, 0}, 0.5), Without(cut)};
}

// Base and wall, a hole through the wall, and on the base a boss with a bore, a
// cone and a round dimple.
std::vector<SolidPrimitive> Bracket() {
  const double top = 0.14;  // of the base
  return {Box({0, 0, 0}, {1, 0.7, top}),
          Box({0, 0, 0}, {0.14, 0.7, 0.6}),
          Cylinder({0.4, 0.24, top / 2}, {0, 0, 0.22}, 0.15),
          Frustum({0.76, 0.48, top}, {0, 0, 0.24}, 0.14, 0.07),
          Hole({0, 0.35, 0.38}, {0.14, 0.35, 0.38}, 0.13),
          Hole({0.4, 0.24, 0}, {0.4, 0.24, 0.29}, 0.08),
          Without(Sphere({0.78, 0.18, top + 0.06}, 0.12), kHoleAlbedo)};
}

std::vector<SolidPrimitive> House() {
  const double eaves = 0.5;
  const double ridge = 0.78;
  const Vector3d along = Vector3d::UnitX();
  const Vector3d front = Vector3d(0, 0.41, ridge - eaves).normalized();
  const Vector3d back = Vector3d(0, -0.41, ridge - eaves).normalized();
  std::vector<SolidPrimitive> parts = {
      Painted(kWood, Box({-0.05, -0.06, eaves - 0.04}, {1.05, 0.76, 1})),
      Painted(kBrick, AboveSlope({0.5, 0.35, ridge}, along, front)),
      Painted(kBrick, AboveSlope({0.5, 0.35, ridge}, -along, back)),
      Painted(kBrick, Box({0, 0, -0.02}, {1, 0.7, eaves - 0.03})),
      Painted(kBrick, Box({0.7, 0.44, 0.5}, {0.82, 0.56, 0.88})),
      Box({-0.15, -0.35, -0.05}, {1.15, 0.82, 0}),
      Painted(kWood, Without(Box({0.42, -0.1, 0.02}, {0.58, 0.03, 0.33}), 0.9)),
      Box({0.4, -0.07, -0.01}, {0.6, 0.01, 0.02}),
      Cylinder({-0.07, -0.15, -0.01}, {0, 0, 0.34}, 0.035),
      Sphere({1.02, -0.2, 0.05}, 0.08),
      FlatSheet({0.38, 0, 0.42}, {0.24, 0, 0}, {0, -0.14, -0.05}),
      Painted(kPrint, FlatSheet({0.12, -0.3, 0}, {0.2, 0.06, 0}, {0, 0, 0.2}))};
  AddWindow(0.12, parts);
  AddWindow(0.7, parts);
  return parts;
}

std::vector<SolidPrimitive> Table() {
  std::vector<SolidPrimitive> parts = {
      Painted(kWood, Box({0, 0, -0.06}, {1, 0.8, 0})),
      Turned(20, Painted(kPrint, Box({0.12, 0.4, -0.01}, {0.4, 0.6, 0.4}))),
      Turned(-12, Painted(kBrick, Box({0.68, 0.5, -0.01}, {0.94, 0.72, 0.2}))),
      Painted(kPrint, FlatSheet({0.36, 0.12, 0}, {0.2, 0.07, 0}, {0, 0, 0.2})),
      // A folded card.
      FlatSheet({0.44, 0.76, 0}, {0.18, 0, 0}, {0, -0.05, 0.2}),
      FlatSheet({0.44, 0.66, 0}, {0.18, 0, 0}, {0, 0.05, 0.2}),
      FlatSheet({0.86, 0.32, 0}, {0.1, 0.1, 0}, {0, 0, 0.16}),
      Sphere({0.18, 0.2, 0.07}, 0.09),
      Cylinder({0.78, 0.18, -0.01}, {0, 0, 0.17}, 0.085),
      Without(Cylinder({0.78, 0.18, 0.02}, {0, 0, 0.2}, 0.07), kHoleAlbedo)};
  AddBottle({0.56, 0.38, 0}, parts);
  return parts;
}

std::vector<SolidPrimitive> Knobs() {
  std::vector<SolidPrimitive> parts;
  AddRounded({0, 0, 0}, {1, 0.7, 0.2}, 0.07, parts);
  AddRounded({0.1, 0.12, 0.12}, {0.42, 0.58, 0.42}, 0.05, parts);
  AddKnob({0.62, 0.22, 0.2}, 0.05, 0.1, 0.1, parts);
  AddKnob({0.26, 0.35, 0.42}, 0.03, 0.05, 0.06, parts);
  AddBottle({0.8, 0.5, 0.2}, parts);
  parts.back().pattern = SurfacePattern::kNone;
  return parts;
}

// Pieces without a pattern of their own take turns.
void PaintMixed(std::vector<SolidPrimitive>& primitives) {
  constexpr std::array kTurns = {kBrick, kWood, kPrint};
  std::size_t turn = 0;
  for (SolidPrimitive& primitive : primitives) {
    if (primitive.is_added) primitive.pattern = kTurns[turn++ % kTurns.size()];
  }
}

void Paint(SurfacePattern pattern, std::vector<SolidPrimitive>& primitives) {
  const bool has_own = std::ranges::any_of(primitives, [](const auto& p) {
    return p.pattern != SurfacePattern::kNone;
  });
  if (pattern == SurfacePattern::kMixed) {
    if (!has_own) PaintMixed(primitives);
    return;
  }
  for (SolidPrimitive& primitive : primitives) {
    if (primitive.is_added || pattern == SurfacePattern::kNone) {
      primitive.pattern = pattern;
    }
  }
}

std::vector<SolidPrimitive> Primitives(SyntheticSolid solid, int num_views) {
  switch (solid) {
    case SyntheticSolid::kBlock:
      return Block();
    case SyntheticSolid::kCylinder:
      return UprightCylinder();
    case SyntheticSolid::kCone:
      return Cone();
    case SyntheticSolid::kSphere:
      return CutSphere();
    case SyntheticSolid::kFacade:
      return Facade(num_views);
    case SyntheticSolid::kHouse:
      return House();
    case SyntheticSolid::kTable:
      return Table();
    case SyntheticSolid::kKnobs:
      return Knobs();
    case SyntheticSolid::kRoom:
      return Room();
    case SyntheticSolid::kPart:
      break;
  }
  return Bracket();
}

}  // namespace

Solid MakeSolid(SyntheticSolid solid,
                double scale,
                int num_views,
                SurfacePattern pattern) {
  std::vector<SolidPrimitive> primitives = Primitives(solid, num_views);
  Paint(pattern, primitives);
  const Eigen::AlignedBox3d box = BoundingBox(primitives);
  const Vector3d sides = box.sizes();
  CURVIX_CHECK(sides.minCoeff() > 0, "the solid has no volume");
  const double factor =
      scale / (solid == SyntheticSolid::kFacade ? sides.z() : sides.maxCoeff());
  for (SolidPrimitive& primitive : primitives) {
    Vector3d& place = primitive.world_from_own.translation;
    place = factor * (place - box.center());
    primitive.size *= factor;
  }
  return Solid(std::move(primitives));
}

}  // namespace curvix
