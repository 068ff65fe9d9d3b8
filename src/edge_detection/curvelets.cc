// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/curvelets.h"

#include <Eigen/Core>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/grid_index.h"
#include "geometry/detected_edge.h"

namespace curvix {
namespace {

// Largest angle between the tangents of neighbours and their chord (Sec. 5).
// Where a contour bends more within a step, it has a corner.
constexpr double kMaxNeighborAngle = DegToRad(15);

// Offers edges to each other as neighbours, pair by pair.
class Linker {
 public:
  Linker(const std::vector<Edge2d>& edges, const EdgeDetectionOptions& options)
      : edges_(edges),
        max_distance_(options.max_neighbor_distance_px),
        min_cosine_(std::cos(kMaxNeighborAngle)),
        rounded_min_cosine_(static_cast<float>(min_cosine_ - 1e-5)),
        neighbors_(edges.size()),
        distances_(edges.size(), {max_distance_, max_distance_}) {}

  std::vector<EdgeNeighbors> Link() {
    GridIndex(edges_, max_distance_)
        .VisitPairs(
            [this](const IndexedEdge& edge,
                   const IndexedEdge* begin,
                   const IndexedEdge* end) { ConsiderAll(edge, begin, end); });
    return std::move(neighbors_);
  }

 private:
  struct Distances {
    double previous;
    double next;
  };

  // Considers those of [begin, end) that point the same way, which few do. They
  // are collected without branches.
  void ConsiderAll(const IndexedEdge& edge,
                   const IndexedEdge* begin,
                   const IndexedEdge* end) {
    const auto size = static_cast<std::size_t>(end - begin);
    if (parallel_.size() < size) parallel_.resize(size);
    const IndexedEdge** parallel = parallel_.data();
    for (const IndexedEdge* other = begin; other != end; ++other) {
      *parallel = other;
      parallel += edge.tangent.dot(other->tangent) >= rounded_min_cosine_;
    }
    for (const IndexedEdge** other = parallel_.data(); other != parallel;
         ++other) {
      Consider(edge, **other);
    }
  }

  void Consider(const IndexedEdge& a, const IndexedEdge& b) {
    const Eigen::Vector2d tangent_a = a.tangent.cast<double>();
    const Eigen::Vector2d tangent_b = b.tangent.cast<double>();
    if (tangent_a.dot(tangent_b) < min_cosine_) return;
    const Eigen::Vector2d chord = Position(b) - Position(a);
    const double distance = chord.norm();
    if (distance == 0 || distance > max_distance_) return;
    const double min_along = min_cosine_ * distance;
    const double along_a = chord.dot(tangent_a);
    const double along_b = chord.dot(tangent_b);
    if (along_a >= min_along && along_b >= min_along) Join(a, b, distance);
    if (-along_a >= min_along && -along_b >= min_along) Join(b, a, distance);
  }

  // Offers `b` as what follows on `a`.
  void Join(const IndexedEdge& a, const IndexedEdge& b, double distance) {
    const auto i = static_cast<std::size_t>(a.edge_idx);
    const auto j = static_cast<std::size_t>(b.edge_idx);
    Offer(b.edge_idx, distance, neighbors_[i].next, distances_[i].next);
    Offer(a.edge_idx, distance, neighbors_[j].previous, distances_[j].previous);
  }

  static void Offer(std::int32_t candidate_idx,
                    double candidate_distance,
                    std::optional<std::int32_t>& edge_idx,
                    double& distance) {
    const bool nearer = candidate_distance < distance;
    const bool tied = candidate_distance == distance;
    if (!nearer && !(tied && (!edge_idx || candidate_idx < *edge_idx))) return;
    edge_idx = candidate_idx;
    distance = candidate_distance;
  }

  Eigen::Vector2d Position(const IndexedEdge& edge) const {
    return edges_[static_cast<std::size_t>(edge.edge_idx)].position;
  }

  const std::vector<Edge2d>& edges_;
  double max_distance_;
  double min_cosine_;
  float rounded_min_cosine_;  // not above that of floats
  std::vector<EdgeNeighbors> neighbors_;
  std::vector<Distances> distances_;  // to the neighbours found so far
  std::vector<const IndexedEdge*> parallel_;
};

}  // namespace

std::vector<EdgeNeighbors> LinkNeighbors(const std::vector<Edge2d>& edges,
                                         const EdgeDetectionOptions& options) {
  return Linker(edges, options).Link();
}

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
