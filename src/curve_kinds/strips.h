// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How well the images agree on a surface beside a
// curve, and what curves and points near it say of the surfaces that meet
// there.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "curve_kinds/blurred_images.h"
#include "model/posed_view.h"

namespace curvix {

// Directions about the tangent of a curve, in equal steps from `normal`
// towards tangent x normal.
constexpr int kNumDirections = 24;
using DirectionSet = std::bitset<kNumDirections>;

// How far behind a curve, seen from the cameras, a surface beside it may begin:
// at the curve, or beyond a step, in pixels (StripViews::step).
constexpr std::array<double, 4> kDepthsPx = {0, 2, 4, 8};
constexpr std::size_t kNumDepths = kDepthsPx.size();

// A place on a curve, whose strips are compared.
struct StripPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  // unit
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();   // unit, across it
  std::vector<int> views;                              // that see it

  // Of an offset from the place, along `normal` and tangent x normal.
  Eigen::Vector2d Across(const Eigen::Vector3d& offset) const {
    return {offset.dot(normal), offset.dot(tangent.cross(normal))};
  }
  // About the tangent, from `normal`, of an offset from the place; radians.
  double AngleOf(const Eigen::Vector3d& offset) const {
    const Eigen::Vector2d across = Across(offset);
    return std::atan2(across.y(), across.x());
  }
};

// What the images say about surfaces at a depth behind a curve, for the two
// sides of the curve in the images and each direction of a surface away from
// it: the logarithm of the Bayes factor of "this surface shows on this side" to
// "the views show different things there". A direction shows on side 0 of a
// view if it lies less than half a turn from the direction of the camera,
// turning from `normal` towards tangent x normal; else on side 1. Minus
// infinity, as at first, where fewer than three views face the surface, and
// where none was looked for.
struct SurfaceEvidence {
  std::array<std::array<float, kNumDirections>, 2> log_bayes;

  SurfaceEvidence() {
    for (auto& side : log_bayes) {
      side.fill(-std::numeric_limits<float>::infinity());
    }
  }
};

// Unit, from a surface that leads in direction `angle` and shows on `side`,
// away from the cameras; components as of StripPlace::Across().
inline Eigen::Vector2d AwayFromCameras(double angle, std::size_t side) {
  const Eigen::Vector2d away(-std::sin(angle), std::cos(angle));
  return side == 0 ? away : -away;
}

// How far the nearest other curve is in each direction, world units; infinity:
// none is near.
using CurveDistances = std::array<double, kNumDirections>;

// Views whose strips are compared.
struct StripViews {
  std::vector<int> views;
  // Of the pixels of each of these images, with the strips.
  std::vector<Eigen::AlignedBox2i> boxes;
  double step = 0;  // a pixel of the images at the place, world units
};

// Some of the views that see the place; none if they are too few. One of
// `views` and `images` per view of the scene, here and below; the images need
// no pixels yet.
StripViews ChooseStripViews(const StripPlace& place,
                            const Scene& scene,
                            const std::vector<PosedView>& views,
                            const std::vector<BlurredImage>& images);

// The strips of the `chosen` views, whose pixels have been read, on surfaces in
// the `directions`, `depth` (world units) behind the curve. A surface may end
// at the nearest other curve in its direction from this one.
SurfaceEvidence CompareStrips(const StripPlace& place,
                              const StripViews& chosen,
                              const CurveDistances& other_curves,
                              const DirectionSet& directions,
                              double depth,
                              const Scene& scene,
                              const std::vector<PosedView>& views,
                              const std::vector<BlurredImage>& images);

// How far the nearest of the `positions` on other curves is in each direction;
// those a few pixels (of length `pixel`, world units) beside the plane across
// the curve count. Infinity without any.
CurveDistances DistancesByDirection(
    const StripPlace& place,
    double pixel,
    const std::vector<Eigen::Vector3d>& positions);

// Adds what points nearby say: a point in the direction of a surface speaks
// for it, one in another direction against it; directions are those from where
// a surface begins, `depth` behind the curve. `points` are on other curves or
// COLMAP's, `pixel` is the length of a pixel at the place; world units.
void AddNearbyPoints(const StripPlace& place,
                     double pixel,
                     const std::vector<PosedView>& views,
                     const std::vector<Eigen::Vector3d>& points,
                     double depth,
                     SurfaceEvidence* evidence);

}  // namespace curvix
