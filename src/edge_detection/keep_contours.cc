// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Selection of the edges of an image.
#include "edge_detection/detect_view_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <tuple>

#include "base/angles.h"
#include "base/check.h"
#include "model/contours.h"

namespace curvix {
namespace {

constexpr double kStraightDeg = 15;
// Short contours are weak, and dropped, if their mean gradient is below this
// many times the weakest gradient kept; up to 1 drops none.
constexpr double kShortContourFactor = 2;

const Edge2d& At(const std::vector<Edge2d>& edges, std::int32_t edge_idx) {
  return edges[static_cast<std::size_t>(edge_idx)];
}

bool PointTheSameWay(const Edge2d& a, const Edge2d& b) {
  const double turn = std::abs(static_cast<double>(a.angle - b.angle));
  return std::min(turn, 2 * kPi - turn) < DegToRad(kStraightDeg);
}

// The mean, over the edges of a contour, of the length of the straight run in
// which each lies. A run ends where the direction is kStraightDeg off its
// first. Pixels, >= 1.
double MeanStraightRun(const std::vector<Edge2d>& edges,
                       std::span<const std::int32_t> path) {
  double sum_px = 0;
  std::size_t begin = 0;
  for (std::size_t k = 1; k <= path.size(); ++k) {
    const Edge2d& first = At(edges, path[begin]);
    if (k < path.size() && PointTheSameWay(At(edges, path[k]), first)) continue;
    const Edge2d& last = At(edges, path[k - 1]);
    sum_px += static_cast<double>(k - begin) *
              (1 + (last.position - first.position).norm());
    begin = k;
  }
  return sum_px / static_cast<double>(path.size());
}

double MeanStrength(const std::vector<Edge2d>& edges,
                    std::span<const std::int32_t> path) {
  double sum = 0;
  for (const std::int32_t i : path) {
    sum += static_cast<double>(At(edges, i).strength);
  }
  return sum / static_cast<double>(path.size());
}

// How much each contour tells of structure: the mean prominence of its edges
// times the square root of the length of its straight runs. Foliage and gravel
// are short, bent and crowded.
std::vector<double> MeasureStructure(const std::vector<Edge2d>& edges,
                                     const Contours& paths,
                                     double spacing_px) {
  const std::vector<double> prominence = Prominence(edges, spacing_px);
  std::vector<double> structure(paths.size());
  for (std::size_t c = 0; c < paths.size(); ++c) {
    const std::span<const std::int32_t> path = paths[c];
    double sum = 0;
    for (const std::int32_t i : path) {
      sum += prominence[static_cast<std::size_t>(i)];
    }
    structure[c] = sum / static_cast<double>(path.size()) *
                   std::sqrt(MeanStraightRun(edges, path));
  }
  return structure;
}

std::vector<Edge2d> Selected(const std::vector<Edge2d>& edges,
                             const std::vector<bool>& is_selected) {
  std::vector<Edge2d> selected;
  selected.reserve(
      static_cast<std::size_t>(std::ranges::count(is_selected, true)));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (is_selected[i]) selected.push_back(edges[i]);
  }
  return selected;
}

// The number of edges of the contours that are kept.
std::int64_t NumKept(const Contours& paths, const std::vector<bool>& is_kept) {
  std::int64_t num_edges = 0;
  for (std::size_t c = 0; c < paths.size(); ++c) {
    if (is_kept[c]) num_edges += std::ssize(paths[c]);
  }
  return num_edges;
}

// Of the contours that are kept, keeps the first that fit.
void KeepStructure(const Contours& paths,
                   const std::vector<double>& structure,
                   double min_num_edges,
                   std::int64_t max_edges,
                   std::vector<bool>& is_kept) {
  using Rank =
      std::tuple<bool, double, std::size_t>;  // the first is kept first
  std::vector<Rank> order;
  for (std::size_t c = 0; c < paths.size(); ++c) {
    if (!is_kept[c]) continue;
    const bool is_short = static_cast<double>(paths[c].size()) < min_num_edges;
    order.emplace_back(is_short, -structure[c], c);
  }
  std::ranges::sort(order);
  std::int64_t num_edges = 0;
  for (const Rank& rank : order) {
    const std::size_t c = std::get<std::size_t>(rank);
    num_edges += std::ssize(paths[c]);
    is_kept[c] = num_edges <= max_edges;
  }
}

// Marks the first edge of a contour, and then one each `spacing_px` along it,
// on average.
void MarkSpaced(const std::vector<Edge2d>& edges,
                std::span<const std::int32_t> path,
                double spacing_px,
                std::vector<bool>& is_marked) {
  double since_marked_px = spacing_px;
  const Edge2d* before = &At(edges, path.front());
  for (const std::int32_t i : path) {
    const Edge2d& edge = At(edges, i);
    since_marked_px += (edge.position - before->position).norm();
    before = &edge;
    if (since_marked_px < spacing_px) continue;
    is_marked[static_cast<std::size_t>(i)] = true;
    since_marked_px = std::min(since_marked_px - spacing_px, spacing_px);
  }
}

// 1 <= n <= the number of values.
double NthLargest(std::vector<double> values, std::int64_t n) {
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(n - 1);
  std::nth_element(values.begin(), nth, values.end(), std::greater<>());
  return *nth;
}

}  // namespace

std::int32_t DropLeastProminent(std::int64_t max_edges,
                                std::vector<LocatedEdge>* edges) {
  if (static_cast<std::int64_t>(edges->size()) <= max_edges) return 0;
  std::vector<double> prominence;
  prominence.reserve(edges->size());
  for (const LocatedEdge& edge : *edges) prominence.push_back(Prominence(edge));
  const double least = NthLargest(prominence, max_edges);
  std::size_t num_kept = 0;
  for (std::size_t i = 0; i < edges->size(); ++i) {
    if (prominence[i] >= least) (*edges)[num_kept++] = (*edges)[i];
  }
  const std::size_t num_dropped = edges->size() - num_kept;
  edges->resize(num_kept);
  return static_cast<std::int32_t>(num_dropped);
}

KeptEdges KeepContours(const std::vector<Edge2d>& edges,
                       const std::vector<EdgeNeighbors>& neighbors,
                       const EdgeDetectionOptions& options,
                       const ContourLimits& limits) {
  CURVIX_CHECK(edges.size() == neighbors.size(), edges.size() << " edges");
  const Contours paths(neighbors);
  const double weak = kShortContourFactor * limits.min_gradient;
  const double min_num_edges =
      options.min_contour_edges / (2 * limits.spacing_px);
  std::vector<bool> is_kept(paths.size());
  KeptEdges kept;
  for (std::size_t c = 0; c < paths.size(); ++c) {
    is_kept[c] = static_cast<double>(paths[c].size()) >= min_num_edges ||
                 MeanStrength(edges, paths[c]) >= weak;
    if (is_kept[c]) continue;
    kept.num_isolated += static_cast<std::int32_t>(paths[c].size());
  }
  if (NumKept(paths, is_kept) > limits.max_edges) {
    KeepStructure(paths,
                  MeasureStructure(edges, paths, limits.spacing_px),
                  min_num_edges,
                  limits.max_edges,
                  is_kept);
  }
  const std::int64_t num_kept = NumKept(paths, is_kept);
  const double spacing_px =
      num_kept > limits.max_unthinned_edges ? limits.thinned_spacing_px : 0;
  std::vector<bool> is_selected(edges.size());
  for (std::size_t c = 0; c < paths.size(); ++c) {
    if (is_kept[c]) MarkSpaced(edges, paths[c], spacing_px, is_selected);
  }
  kept.edges = Selected(edges, is_selected);
  const auto size = static_cast<std::int64_t>(edges.size());
  const auto num_selected = static_cast<std::int64_t>(kept.edges.size());
  kept.num_over_limit =
      static_cast<std::int32_t>(size - num_kept - kept.num_isolated);
  kept.num_thinned_out = static_cast<std::int32_t>(num_kept - num_selected);
  return kept;
}

namespace {

constexpr double kDistancePx = 8;
constexpr int kSquarePx = 9;
// A mean strength beside an edge, as a share of its own, that halves its
// prominence.
constexpr double kCrowded = 0.1;

cv::Point PixelAt(const Eigen::Vector2d& position) {
  return {cvFloor(position.x()), cvFloor(position.y())};
}

float Strength(const Edge2d& edge) { return edge.strength; }
float Strength(const LocatedEdge& edge) { return edge.strength(); }

// Unit, towards the bright side.
Eigen::Vector2d Normal(const Edge2d& edge) {
  return {-std::sin(edge.angle), std::cos(edge.angle)};
}
Eigen::Vector2d Normal(const LocatedEdge& edge) {
  return edge.gradient.cast<double>() / static_cast<double>(edge.strength());
}

// The image, and what of edges lies outside it, where SeparateEdges() and the
// like may have moved them; on the far sides only as much as has edges.
template <typename Edge>
cv::Rect PixelsOf(const std::vector<Edge>& edges) {
  cv::Point first(0, 0), last(0, 0);
  for (const Edge& edge : edges) {
    const cv::Point pixel = PixelAt(edge.position);
    first = {std::min(first.x, pixel.x), std::min(first.y, pixel.y)};
    last = {std::max(last.x, pixel.x), std::max(last.y, pixel.y)};
  }
  return {first, last + cv::Point(1, 1)};
}

// The mean strength in the square about each of the pixels.
template <typename Edge>
cv::Mat1f StrengthPerPixel(const std::vector<Edge>& edges,
                           const cv::Rect& pixels) {
  cv::Mat1f strengths(pixels.size(), 0.0f);
  for (const Edge& edge : edges) {
    strengths(PixelAt(edge.position) - pixels.tl()) += Strength(edge);
  }
  cv::boxFilter(strengths,
                strengths,
                CV_32F,
                {kSquarePx, kSquarePx},
                {-1, -1},
                true,
                cv::BORDER_CONSTANT);
  return strengths;
}

template <typename Edge>
std::vector<float> CrowdingOf(const std::vector<Edge>& edges,
                              double spacing_px) {
  const cv::Rect pixels = PixelsOf(edges);
  const cv::Mat1f strengths = StrengthPerPixel(edges, pixels);
  const auto strength_at = [&](const Eigen::Vector2d& position) {
    const cv::Point pixel = PixelAt(position);
    return pixels.contains(pixel) ? strengths(pixel - pixels.tl()) : 0.0f;
  };
  const auto weight = static_cast<float>(2 * spacing_px);
  std::vector<float> crowding;
  crowding.reserve(edges.size());
  for (const Edge& edge : edges) {
    const Eigen::Vector2d aside = kDistancePx * Normal(edge);
    crowding.push_back(weight *
                       std::min(strength_at(edge.position + aside),
                                strength_at(edge.position - aside)) /
                       Strength(edge));
  }
  return crowding;
}

double Prominence(float strength, float crowding) {
  return static_cast<double>(strength) /
         (1 + static_cast<double>(crowding) / kCrowded);
}

}  // namespace

void MeasureCrowding(double spacing_px, std::vector<LocatedEdge>* edges) {
  const std::vector<float> crowding = CrowdingOf(*edges, spacing_px);
  for (std::size_t i = 0; i < edges->size(); ++i) {
    (*edges)[i].crowding = crowding[i];
  }
}

double Prominence(const LocatedEdge& edge) {
  return Prominence(edge.strength(), edge.crowding);
}

std::vector<double> Prominence(const std::vector<Edge2d>& edges,
                               double spacing_px) {
  const std::vector<float> crowding = CrowdingOf(edges, spacing_px);
  std::vector<double> prominence;
  prominence.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    prominence.push_back(Prominence(edges[i].strength, crowding[i]));
  }
  return prominence;
}

}  // namespace curvix
