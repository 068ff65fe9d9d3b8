// SPDX-License-Identifier: BSD-3-Clause
// Noisy 3D edges of known curves, with the 2D edges that support them.
#pragma once

#include <curvix/edges.h>
#include <curvix/scene.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// A curve in space: position and unit tangent at arc length s in [0, length].
struct TestCurve {
  double length = 0;
  bool closed = false;
  std::function<Eigen::Vector3d(double)> position;
  std::function<Eigen::Vector3d(double)> tangent;
};

TestCurve LineCurve(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
// In the plane z = center.z.
TestCurve CircleCurve(const Eigen::Vector3d& center, double radius);
// Around the z axis, rising by `pitch` per turn.
TestCurve HelixCurve(double radius, double pitch, double num_turns);
// The twelve edges of a cube with side 2 around the origin.
std::vector<TestCurve> CubeCurves();

// `num_views` cameras of 800 x 800 pixels, focal length 800, on a ring of
// radius 6 around the z axis, 2.5 above the origin and looking at it. One pixel
// is about 1/125 at the origin.
std::vector<PosedView> RingOfViews(int num_views);

// Pinholes of the size and the calibration of `views`.
Scene SceneOf(const std::vector<PosedView>& views);

// About one pixel at the origin in these views.
inline constexpr double kPx = 0.0075;

// The 2D edges of the curves in each view, exact and half a pixel apart, in the
// order of the curves; where on the curve the first lies is random. Every curve
// is taken as visible in all views, and must be in front of them.
std::vector<EdgeMap> ExactEdgeMaps(const std::vector<TestCurve>& curves,
                                   const std::vector<PosedView>& views,
                                   std::uint64_t seed);

// As of sharp images, with the same grey levels beside every edge.
void MakeSharp(std::vector<EdgeMap>& maps);

// Turns edges by half a turn: the other side is the bright one.
void SwapSides(std::vector<Edge2d>& edges);

struct SyntheticEdgeOptions {
  int num_views = 12;
  double spacing = 0.008;      // between edges of a track, world units
  int num_tracks = 1;          // times that each curve is sampled
  double track_sigma = 0;      // offset of a whole track across the curve
  double lateral_sigma = 0;    // offset of single edges across the curve
  double tangent_sigma = 0;    // turn of single edges, radians
  double support_share = 0.6;  // of the views, chosen for each edge
  std::uint64_t seed = 1;
};

struct SyntheticEdges {
  std::vector<PosedView> views;
  std::vector<EdgeMap> edge_maps;  // exact, every half pixel along the curves
  std::vector<Edge3d> edges;       // noisy, curve by curve and track by track
  std::vector<int> curve_of;       // of each 3D edge
};

// Every curve is taken as visible in all views. An edge is supported, in the
// views chosen for it, by the 2D edge of its curve that is nearest to the true
// place. Signs of tangents are random.
SyntheticEdges MakeSyntheticEdges(const std::vector<TestCurve>& curves,
                                  const SyntheticEdgeOptions& options);

}  // namespace curvix
