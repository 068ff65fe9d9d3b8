// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Which edges of a photograph are worth keeping.
#include "edge_detection/keep_contours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <tuple>
#include <utility>

#include "base/angles.h"
#include "base/check.h"
#include "edge_detection/prominence.h"

namespace curvix {
namespace {

constexpr std::int32_t kUnlabelled = -1;
constexpr double kStraightDeg = 15;

using Link = std::optional<std::int32_t> EdgeNeighbors::*;

// Labels the contour from `start` on, along `ahead`, as far as its links are
// mutual and lead to edges without a label.
void LabelAlong(const std::vector<EdgeNeighbors>& neighbors,
                Link ahead,
                Link back,
                std::int32_t start,
                std::vector<std::int32_t>& labels) {
  const std::int32_t label = labels[static_cast<std::size_t>(start)];
  std::int32_t at = start;
  while (const auto other = neighbors[static_cast<std::size_t>(at)].*ahead) {
    const auto j = static_cast<std::size_t>(*other);
    if (labels[j] != kUnlabelled || neighbors[j].*back != at) return;
    labels[j] = label;
    at = *other;
  }
}

using Path = std::vector<std::int32_t>;  // edges along a contour, in order

// The edges from `start` on, along `ahead`, without it, as long as they have
// its label.
Path FollowFrom(const std::vector<EdgeNeighbors>& neighbors,
                const std::vector<std::int32_t>& labels,
                Link ahead,
                Link back,
                std::int32_t start) {
  Path path;
  std::int32_t at = start;
  while (const auto other = neighbors[static_cast<std::size_t>(at)].*ahead) {
    const auto j = static_cast<std::size_t>(*other);
    if (*other == start || neighbors[j].*back != at ||
        labels[j] != labels[static_cast<std::size_t>(start)]) {
      break;
    }
    at = *other;
    path.push_back(at);
  }
  return path;
}

// The edges of each contour from one end to the other; of a closed one, from
// its first edge on.
std::vector<Path> OrderAlong(const std::vector<EdgeNeighbors>& neighbors,
                             const std::vector<std::int32_t>& labels) {
  constexpr Link kNext = &EdgeNeighbors::next;
  constexpr Link kPrevious = &EdgeNeighbors::previous;
  std::vector<Path> paths;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (static_cast<std::size_t>(labels[i]) != paths.size()) continue;
    const auto start = static_cast<std::int32_t>(i);
    const Path ahead = FollowFrom(neighbors, labels, kNext, kPrevious, start);
    const bool is_closed =
        !ahead.empty() &&
        neighbors[static_cast<std::size_t>(ahead.back())].next == start;
    Path path;
    if (!is_closed) {
      path = FollowFrom(neighbors, labels, kPrevious, kNext, start);
      std::reverse(path.begin(), path.end());
    }
    path.push_back(start);
    path.insert(path.end(), ahead.begin(), ahead.end());
    paths.push_back(std::move(path));
  }
  return paths;
}

// The mean, over the edges of a contour, of the length of the straight run in
// which each lies. A run ends where the direction is kStraightDeg off its
// first. Pixels, >= 1.
double MeanStraightRun(const std::vector<Edge2d>& edges, const Path& path) {
  double sum_px = 0;
  std::size_t begin = 0;
  for (std::size_t k = 1; k <= path.size(); ++k) {
    const Edge2d& first = edges[static_cast<std::size_t>(path[begin])];
    const bool goes_on =
        k < path.size() &&
        std::cos(static_cast<double>(
            edges[static_cast<std::size_t>(path[k])].angle - first.angle)) >
            std::cos(DegToRad(kStraightDeg));
    if (goes_on) continue;
    const Edge2d& last = edges[static_cast<std::size_t>(path[k - 1])];
    sum_px += static_cast<double>(k - begin) *
              (1 + (last.position - first.position).norm());
    begin = k;
  }
  return sum_px / static_cast<double>(path.size());
}

struct Contour {
  std::int64_t num_edges = 0;
  double strength = 0;  // mean of its edges
  bool is_kept = false;
};

std::vector<Contour> Measure(const std::vector<Edge2d>& edges,
                             const std::vector<Path>& paths) {
  std::vector<Contour> contours;
  for (const Path& path : paths) {
    Contour& contour = contours.emplace_back();
    contour.num_edges = static_cast<std::int64_t>(path.size());
    for (const std::int32_t i : path) {
      contour.strength +=
          static_cast<double>(edges[static_cast<std::size_t>(i)].strength);
    }
    contour.strength /= static_cast<double>(path.size());
  }
  return contours;
}

// How much each contour tells of structure: the mean prominence of its edges
// times the square root of the length of its straight runs. Foliage and gravel
// are short, bent and crowded.
std::vector<double> MeasureStructure(const std::vector<Edge2d>& edges,
                                     const std::vector<Path>& paths) {
  const std::vector<double> prominence = Prominence(edges);
  std::vector<double> structure;
  structure.reserve(paths.size());
  for (const Path& path : paths) {
    double sum = 0;
    for (const std::int32_t i : path) {
      sum += prominence[static_cast<std::size_t>(i)];
    }
    structure.push_back(sum / static_cast<double>(path.size()) *
                        std::sqrt(MeanStraightRun(edges, path)));
  }
  return structure;
}

std::int64_t NumKept(const std::vector<Contour>& contours) {
  std::int64_t num_edges = 0;
  for (const Contour& contour : contours) {
    if (contour.is_kept) num_edges += contour.num_edges;
  }
  return num_edges;
}

// Of the contours that are kept, keeps the first that fit.
void KeepStructure(const std::vector<double>& structure,
                   std::int64_t min_contour_edges,
                   std::int64_t max_edges,
                   std::vector<Contour>& contours) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (contours[i].is_kept) order.push_back(i);
  }
  const auto rank = [&](std::size_t i) {
    const bool is_short = contours[i].num_edges < min_contour_edges;
    return std::tuple(is_short, -structure[i], i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return rank(a) < rank(b);
  });
  std::int64_t num_edges = 0;
  for (const std::size_t i : order) {
    num_edges += contours[i].num_edges;
    contours[i].is_kept = num_edges <= max_edges;
  }
}

}  // namespace

std::int32_t DropLeastProminent(std::int64_t max_edges,
                                std::vector<Edge2d>* edges) {
  if (static_cast<std::int64_t>(edges->size()) <= max_edges) return 0;
  const std::vector<double> prominence = Prominence(*edges);
  std::vector<double> falling = prominence;
  const auto last =
      falling.begin() + static_cast<std::ptrdiff_t>(max_edges - 1);
  std::nth_element(falling.begin(), last, falling.end(), std::greater<>());
  std::vector<Edge2d> kept;
  for (std::size_t i = 0; i < edges->size(); ++i) {
    if (prominence[i] >= *last) kept.push_back((*edges)[i]);
  }
  std::swap(kept, *edges);
  return static_cast<std::int32_t>(kept.size() - edges->size());
}

std::vector<std::int32_t> LabelContours(
    const std::vector<EdgeNeighbors>& neighbors) {
  std::vector<std::int32_t> labels(neighbors.size(), kUnlabelled);
  std::int32_t num_contours = 0;
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    if (labels[i] != kUnlabelled) continue;
    labels[i] = num_contours++;
    const auto start = static_cast<std::int32_t>(i);
    constexpr Link kNext = &EdgeNeighbors::next;
    constexpr Link kPrevious = &EdgeNeighbors::previous;
    LabelAlong(neighbors, kNext, kPrevious, start, labels);
    LabelAlong(neighbors, kPrevious, kNext, start, labels);
  }
  return labels;
}

KeptEdges KeepContours(const std::vector<Edge2d>& edges,
                       const std::vector<EdgeNeighbors>& neighbors,
                       const EdgeDetectionOptions& options,
                       double min_gradient,
                       std::int64_t max_edges) {
  CURVIX_CHECK(edges.size() == neighbors.size(), edges.size() << " edges");
  const std::vector<std::int32_t> labels = LabelContours(neighbors);
  const std::vector<Path> paths = OrderAlong(neighbors, labels);
  std::vector<Contour> contours = Measure(edges, paths);
  const double weak = options.short_contour_factor * min_gradient;
  KeptEdges kept;
  for (Contour& contour : contours) {
    contour.is_kept = contour.num_edges >= options.min_contour_edges ||
                      contour.strength >= weak;
    if (contour.is_kept) continue;
    kept.num_isolated += static_cast<std::int32_t>(contour.num_edges);
  }
  if (NumKept(contours) > max_edges) {
    KeepStructure(MeasureStructure(edges, paths),
                  options.min_contour_edges,
                  max_edges,
                  contours);
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (contours[static_cast<std::size_t>(labels[i])].is_kept) {
      kept.edges.push_back(edges[i]);
    }
  }
  kept.num_over_limit =
      static_cast<std::int32_t>(edges.size() - kept.edges.size()) -
      kept.num_isolated;
  return kept;
}

std::vector<Edge2d> ThinContours(const std::vector<Edge2d>& edges,
                                 const std::vector<EdgeNeighbors>& neighbors,
                                 double spacing_px) {
  std::vector<bool> is_kept(edges.size(), false);
  for (const Path& path : OrderAlong(neighbors, LabelContours(neighbors))) {
    double since_kept_px = spacing_px;
    const Edge2d* before = nullptr;
    for (const std::int32_t edge_idx : path) {
      const auto i = static_cast<std::size_t>(edge_idx);
      if (before != nullptr) {
        since_kept_px += (edges[i].position - before->position).norm();
      }
      before = &edges[i];
      is_kept[i] = since_kept_px >= spacing_px;
      if (is_kept[i]) since_kept_px = 0;
    }
  }
  std::vector<Edge2d> kept;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (is_kept[i]) kept.push_back(edges[i]);
  }
  return kept;
}

}  // namespace curvix
