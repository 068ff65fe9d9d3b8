// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/smooth_contours.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "geometry/detected_edge.h"

namespace curvix {
namespace {

constexpr double kReachPx = 16;
constexpr double kMinReachPx = 2;
constexpr int kMinNumPlaces = 5;
constexpr double kMaxResidualPx = 0.25;  // root mean square
constexpr double kMaxBendRad = 1;        // on either side

// A place of the contour, seen from the edge in the middle.
struct ContourPlace {
  double length = 0;  // of the contour up to here, < 0 behind the edge, pixels
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();  // from the edge, pixels
};

using Link = std::optional<std::int32_t> EdgeNeighbors::*;

// Appends the places ahead (`next`) or behind (`previous`), nearest first, and
// returns how far they reach, pixels.
double Walk(const std::vector<Edge2d>& edges,
            const std::vector<EdgeNeighbors>& neighbors,
            std::size_t start,
            Link link,
            std::vector<ContourPlace>* places) {
  const double sign = link == &EdgeNeighbors::next ? 1 : -1;
  double length = 0;
  std::size_t here = start;
  while (neighbors[here].*link) {
    const auto there = static_cast<std::size_t>(*(neighbors[here].*link));
    const double step = (edges[there].position - edges[here].position).norm();
    if (there == start || length + step > kReachPx) break;
    length += step;
    here = there;
    places->push_back(
        {sign * length, edges[here].position - edges[start].position});
  }
  return length;
}

// A parabola in the length of the contour.
struct Parabola {
  double shift = 0;  // at the edge, across its tangent, pixels
  double turn = 0;   // of the tangent, radians
  double curvature = 0;
  double residual = 0;
};

// Fitted to the places up to `reach` away, in the frame of the tangent; nullopt
// if these are too few.
std::optional<Parabola> FitParabola(const std::vector<ContourPlace>& places,
                                    const Eigen::Vector2d& tangent,
                                    double reach) {
  const Eigen::Vector2d normal(-tangent.y(), tangent.x());
  // Sums of powers of the lengths, and of their products with what is across.
  double s1 = 0, s2 = 0, s3 = 0, s4 = 0, a0 = 0, a1 = 0, a2 = 0;
  double sum_squares = 0, sum_along = 0;
  int size = 0;
  for (const ContourPlace& place : places) {
    const double s = place.length;
    if (std::abs(s) > reach) continue;
    const double across = normal.dot(place.offset);
    const double square = s * s;
    s1 += s;
    s2 += square;
    s3 += s * square;
    s4 += square * square;
    a0 += across;
    a1 += across * s;
    a2 += across * square;
    sum_squares += across * across;
    sum_along += s * tangent.dot(place.offset);
    ++size;
  }
  if (size < kMinNumPlaces) return std::nullopt;
  Eigen::Matrix3d information;
  information << size, s1, s2, s1, s2, s3, s2, s3, s4;
  const Eigen::Vector3d vector(a0, a1, a2);
  const Eigen::Vector3d fit = information.ldlt().solve(vector);
  const double rest = std::max(sum_squares - fit.dot(vector), 0.0);
  return Parabola{fit[0],
                  std::atan2(fit[1], sum_along / s2),
                  2 * std::abs(fit[2]),
                  std::sqrt(rest / size)};
}

// The edge, moved and turned by a parabola that fits; else as it is.
Edge2d Smoothed(const Edge2d& edge,
                const std::vector<ContourPlace>& places,
                double reach) {
  const ImageEdge before = ToImageEdge(edge);
  for (; reach >= kMinReachPx; reach /= 2) {
    const auto fit = FitParabola(places, before.tangent, reach);
    if (!fit) return edge;
    if (!(fit->residual <= kMaxResidualPx) ||
        !(fit->curvature * reach <= kMaxBendRad)) {
      continue;
    }
    Edge2d smoothed = edge;
    smoothed.position += fit->shift * before.Normal();
    smoothed.angle = static_cast<float>(
        WrapDirected(static_cast<double>(edge.angle) + fit->turn));
    return smoothed;
  }
  return edge;
}

}  // namespace

void SmoothContours(const std::vector<EdgeNeighbors>& neighbors,
                    std::vector<Edge2d>* edges) {
  std::vector<Edge2d> smoothed;
  smoothed.reserve(edges->size());
  std::vector<ContourPlace> places;
  for (std::size_t i = 0; i < edges->size(); ++i) {
    places.assign(1, ContourPlace());
    const double ahead =
        Walk(*edges, neighbors, i, &EdgeNeighbors::next, &places);
    const double behind =
        Walk(*edges, neighbors, i, &EdgeNeighbors::previous, &places);
    smoothed.push_back(Smoothed((*edges)[i], places, std::min(ahead, behind)));
  }
  *edges = std::move(smoothed);
}

}  // namespace curvix
