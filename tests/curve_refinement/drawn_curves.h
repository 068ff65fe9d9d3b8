// SPDX-License-Identifier: BSD-3-Clause
// Curves before one camera, in pixels, for tests of the refinement.
#pragma once

#include <curvix/curves.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "geometry/edge_geometry.h"
#include "model/posed_view.h"
#include "tests/support/test_views.h"

namespace curvix {

// World units per pixel in the plane y = 0.
inline constexpr double kPixel = 0.01;

// Of the edges that a detector finds in images.
inline constexpr double kEdgeSigmaPx = 0.15;

// One camera before the plane y = 0, all of which is equally deep.
inline std::vector<PosedView> FrontalViews() {
  return {LookAt({0, -8, 0}, {0, 0, 0})};
}

// A point of the plane y = 0. Pixels.
inline Eigen::Vector3d InPlane(double x, double z) {
  return kPixel * Eigen::Vector3d(x, 0, z);
}

inline CurveSample SampleAt(const Eigen::Vector3d& position,
                            const Eigen::Vector3d& tangent) {
  return {position, tangent.normalized(), 0.05 * kPixel, 40, {{0, 0}}};
}

// A straight curve with a sample per pixel, both ends included.
inline Curve Line(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const int num_steps =
      static_cast<int>(std::lround((to - from).norm() / kPixel));
  Curve curve;
  for (int i = 0; i <= num_steps; ++i) {
    const double fraction = static_cast<double>(i) / num_steps;
    curve.samples.push_back(SampleAt(from + fraction * (to - from), to - from));
  }
  return curve;
}

// An arc about the origin of the plane, angles in radian, about a sample per
// pixel. Closed, if it is the whole circle.
inline Curve Arc(double radius_px, double begin, double end) {
  const bool closed = end - begin >= 2 * std::numbers::pi;
  const int num_steps =
      static_cast<int>(std::lround(radius_px * (end - begin)));
  Curve curve;
  curve.closed = closed;
  for (int i = 0; i < num_steps + (closed ? 0 : 1); ++i) {
    const double angle = begin + (end - begin) * i / num_steps;
    const double x = std::cos(angle), z = std::sin(angle);
    curve.samples.push_back(
        SampleAt(InPlane(radius_px * x, radius_px * z), {-z, 0, x}));
  }
  return curve;
}

// A sine along x from begin_px to end_px, a sample per pixel of x.
inline Curve Wave(double length_px,
                  double amplitude_px,
                  double begin_px,
                  double end_px) {
  const double turn = 2 * std::numbers::pi / length_px;
  Curve curve;
  for (double x = begin_px; x <= end_px; x += 1) {
    curve.samples.push_back(
        SampleAt(InPlane(x, amplitude_px * std::sin(turn * x)),
                 {1, 0, amplitude_px * turn * std::cos(turn * x)}));
  }
  return curve;
}

// Gives each sample a 2D edge of its own, just where it projects, and returns
// the edges of the views.
inline std::vector<EdgeMap> SupportByEdges(const std::vector<PosedView>& views,
                                           std::vector<Curve>& curves) {
  std::vector<EdgeMap> edge_maps(views.size());
  for (Curve& curve : curves) {
    for (CurveSample& sample : curve.samples) {
      sample.support.clear();
      for (std::size_t i = 0; i < views.size(); ++i) {
        const auto projected =
            ProjectEdge(views[i], {sample.position, sample.tangent});
        if (!projected) continue;
        std::vector<Edge2d>& edges = edge_maps[i].edges;
        sample.support.push_back({static_cast<std::int32_t>(i),
                                  static_cast<std::int32_t>(edges.size())});
        edges.push_back({projected->position,
                         static_cast<float>(std::atan2(projected->tangent.y(),
                                                       projected->tangent.x())),
                         10});
      }
    }
  }
  return edge_maps;
}

// To the bright side.
inline void MoveAcross(double distance_px, Edge2d& edge) {
  const auto angle = static_cast<double>(edge.angle);
  edge.position +=
      distance_px * Eigen::Vector2d(-std::sin(angle), std::cos(angle));
}

// The curves and the views of a scene `factor` times as large.
inline std::vector<Curve> Scaled(std::vector<Curve> curves, double factor) {
  for (Curve& curve : curves) {
    for (CurveSample& sample : curve.samples) {
      sample.position *= factor;
      sample.sigma *= factor;
    }
  }
  return curves;
}

inline std::vector<PosedView> Scaled(std::vector<PosedView> views,
                                     double factor) {
  for (PosedView& view : views) {
    view.translation *= factor;
    view.center *= factor;
  }
  return views;
}

// Largest distance between samples in the same place of both; infinite, if
// there are not as many.
inline double LargestDistance(const std::vector<Curve>& a,
                              const std::vector<Curve>& b) {
  constexpr double kDifferent = HUGE_VAL;
  if (a.size() != b.size()) return kDifferent;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto &left = a[i].samples, &right = b[i].samples;
    if (left.size() != right.size()) return kDifferent;
    for (std::size_t k = 0; k < left.size(); ++k) {
      largest =
          std::max(largest, (left[k].position - right[k].position).norm());
    }
  }
  return largest;
}

}  // namespace curvix
