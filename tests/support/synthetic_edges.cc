// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/synthetic_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/angles.h"
#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

constexpr double kTwoPi = 6.28318530717958647692;

// The 2D edges of one curve in one view.
struct Contour {
  std::vector<double> arc_lengths;  // in space, ascending
  std::int32_t first_edge_idx = 0;
};

// Appends the 2D edges of `curve` to `map`, half a pixel apart, starting at the
// share `phase` of a step.
Contour AppendContour(const TestCurve& curve,
                      const PosedView& view,
                      double phase,
                      EdgeMap& map) {
  Contour contour;
  contour.first_edge_idx = static_cast<std::int32_t>(map.edges.size());
  const auto pixel = [&](double s) {
    return view.Pixel(view.InCamera(curve.position(s)));
  };
  double left_px = 0.5 * phase;
  const double step = 0.001;
  for (double s = 0; s + step <= curve.length; s += step) {
    const Eigen::Vector2d move = pixel(s + step) - pixel(s);
    left_px -= move.norm();
    if (left_px > 0) continue;
    left_px += 0.5;
    Edge2d edge;
    edge.position = pixel(s);
    edge.angle = static_cast<float>(std::atan2(move.y(), move.x()));
    contour.arc_lengths.push_back(s);
    map.edges.push_back(edge);
  }
  const auto size = static_cast<std::int32_t>(contour.arc_lengths.size());
  for (std::int32_t k = 0; k < size; ++k) {
    EdgeNeighbors neighbors;
    if (k > 0 || curve.closed) {
      neighbors.previous = contour.first_edge_idx + (k + size - 1) % size;
    }
    if (k + 1 < size || curve.closed) {
      neighbors.next = contour.first_edge_idx + (k + 1) % size;
    }
    map.neighbors.push_back(neighbors);
  }
  return contour;
}

std::int32_t NearestEdge(const Contour& contour, double s) {
  const std::vector<double>& all = contour.arc_lengths;
  auto next = std::lower_bound(all.begin(), all.end(), s);
  if (next == all.end()) --next;
  if (next != all.begin() && s - *(next - 1) < *next - s) --next;
  return contour.first_edge_idx + static_cast<std::int32_t>(next - all.begin());
}

Edge3d NoisyEdge(const TestCurve& curve,
                 double s,
                 const Eigen::Vector3d& track_offset,
                 const SyntheticEdgeOptions& options,
                 Random& random) {
  const Eigen::Vector3d tangent = curve.tangent(s);
  Edge3d edge;
  edge.position = curve.position(s) + track_offset -
                  track_offset.dot(tangent) * tangent +
                  options.lateral_sigma * random.Across(tangent);
  edge.tangent =
      (tangent + options.tangent_sigma * random.Across(tangent)).normalized();
  if (random.Uniform() < 0.5) edge.tangent = -edge.tangent;
  return edge;
}

// The edge nearest to s of some contours; the index of a contour is its view's.
std::vector<EdgeRef> SupportAt(double s,
                               const std::vector<Contour>& contours,
                               double support_share,
                               Random& random) {
  std::vector<EdgeRef> support;
  for (std::size_t v = 0; v < contours.size(); ++v) {
    if (random.Uniform() >= support_share) continue;
    support.push_back(
        {static_cast<std::int32_t>(v), NearestEdge(contours[v], s)});
  }
  return support;
}

}  // namespace

TestCurve LineCurve(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Eigen::Vector3d direction = (to - from).normalized();
  return {(to - from).norm(),
          false,
          [=](double s) -> Eigen::Vector3d { return from + s * direction; },
          [=](double) { return direction; }};
}

TestCurve CircleCurve(const Eigen::Vector3d& center, double radius) {
  return {kTwoPi * radius,
          true,
          [=](double s) -> Eigen::Vector3d {
            const double a = s / radius;
            return center +
                   radius * Eigen::Vector3d(std::cos(a), std::sin(a), 0);
          },
          [=](double s) {
            const double a = s / radius;
            return Eigen::Vector3d(-std::sin(a), std::cos(a), 0);
          }};
}

TestCurve HelixCurve(double radius, double pitch, double num_turns) {
  const double rise = pitch / kTwoPi;
  const double speed = std::hypot(radius, rise);
  return {num_turns * kTwoPi * speed,
          false,
          [=](double s) {
            const double a = s / speed;
            return Eigen::Vector3d(
                radius * std::cos(a), radius * std::sin(a), rise * a);
          },
          [=](double s) -> Eigen::Vector3d {
            const double a = s / speed;
            return Eigen::Vector3d(
                       -radius * std::sin(a), radius * std::cos(a), rise) /
                   speed;
          }};
}

std::vector<TestCurve> CubeCurves() {
  std::vector<TestCurve> curves;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double u : {-1.0, 1.0}) {
      for (const double v : {-1.0, 1.0}) {
        Eigen::Vector3d from;
        from[axis] = -1;
        from[(axis + 1) % 3] = u;
        from[(axis + 2) % 3] = v;
        Eigen::Vector3d to = from;
        to[axis] = 1;
        curves.push_back(LineCurve(from, to));
      }
    }
  }
  return curves;
}

std::vector<PosedView> RingOfViews(int num_views) {
  std::vector<PosedView> views;
  for (int v = 0; v < num_views; ++v) {
    const double a = kTwoPi * v / num_views;
    views.push_back(LookAt({6 * std::cos(a), 6 * std::sin(a), 2.5}, {0, 0, 0}));
  }
  return views;
}

Scene SceneOf(const std::vector<PosedView>& views) {
  Scene scene;
  for (const PosedView& view : views) {
    const Eigen::Matrix3d& k = view.calibration;
    scene.cameras.push_back({CameraModel::kPinhole,
                             view.width,
                             view.height,
                             {k(0, 0), k(1, 1), k(0, 2), k(1, 2)}});
    View& out = scene.views.emplace_back();
    out.camera_idx = static_cast<int>(scene.cameras.size()) - 1;
    out.cam_from_world.rotation = view.rotation;
    out.cam_from_world.translation = view.translation;
  }
  return scene;
}

std::vector<EdgeMap> ExactEdgeMaps(const std::vector<TestCurve>& curves,
                                   const std::vector<PosedView>& views,
                                   std::uint64_t seed) {
  Random random(seed);
  std::vector<EdgeMap> edge_maps(views.size());
  for (const TestCurve& curve : curves) {
    for (std::size_t v = 0; v < views.size(); ++v) {
      AppendContour(curve, views[v], random.Uniform(), edge_maps[v]);
    }
  }
  return edge_maps;
}

void MakeSharp(std::vector<EdgeMap>& maps) {
  for (EdgeMap& map : maps) {
    for (Edge2d& edge : map.edges) {
      edge.level = Eigen::half(120);
      edge.strength = 20;
      edge.sharpness = 1;
    }
  }
}

void SwapSides(std::vector<Edge2d>& edges) {
  for (Edge2d& edge : edges) {
    edge.angle += static_cast<float>(edge.angle > 0 ? -kPi : kPi);
  }
}

SyntheticEdges MakeSyntheticEdges(const std::vector<TestCurve>& curves,
                                  const SyntheticEdgeOptions& options) {
  Random random(options.seed);
  SyntheticEdges made;
  made.views = RingOfViews(options.num_views);
  made.edge_maps.resize(made.views.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    std::vector<Contour> contours;
    for (std::size_t v = 0; v < made.views.size(); ++v) {
      contours.push_back(AppendContour(
          curves[c], made.views[v], random.Uniform(), made.edge_maps[v]));
    }
    for (int track = 0; track < options.num_tracks; ++track) {
      const Eigen::Vector3d track_offset =
          options.track_sigma *
          Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
      for (double s = options.spacing * random.Uniform(); s < curves[c].length;
           s += options.spacing) {
        Edge3d edge = NoisyEdge(curves[c], s, track_offset, options, random);
        edge.support = SupportAt(s, contours, options.support_share, random);
        made.edges.push_back(std::move(edge));
        made.curve_of.push_back(static_cast<int>(c));
      }
    }
  }
  return made;
}

}  // namespace curvix
