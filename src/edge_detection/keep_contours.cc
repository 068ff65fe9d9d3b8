// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Which edges of a photograph are worth keeping.
#include "edge_detection/keep_contours.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <tuple>

#include "base/check.h"

namespace curvix {
namespace {

constexpr std::int32_t kUnlabelled = -1;

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

struct Contour {
  std::int64_t num_edges = 0;
  double strength = 0;  // the sum over its edges, then their mean
  bool is_kept = false;
};

std::vector<Contour> Measure(const std::vector<Edge2d>& edges,
                             const std::vector<std::int32_t>& labels) {
  std::vector<Contour> contours;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto label = static_cast<std::size_t>(labels[i]);
    if (label == contours.size()) contours.emplace_back();
    ++contours[label].num_edges;
    contours[label].strength += edges[i].strength;
  }
  for (Contour& contour : contours) {
    contour.strength /= static_cast<double>(contour.num_edges);
  }
  return contours;
}

// Of the contours that are kept, keeps the first that fit.
void KeepStrongest(std::int64_t min_contour_edges,
                   std::int64_t max_edges,
                   std::vector<Contour>& contours) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (contours[i].is_kept) order.push_back(i);
  }
  const auto rank = [&](std::size_t i) {
    const bool is_short = contours[i].num_edges < min_contour_edges;
    return std::tuple(is_short, -contours[i].strength, i);
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

std::int32_t DropWeakest(std::int64_t max_edges, std::vector<Edge2d>* edges) {
  if (static_cast<std::int64_t>(edges->size()) <= max_edges) return 0;
  std::vector<float> strengths;
  strengths.reserve(edges->size());
  for (const Edge2d& edge : *edges) strengths.push_back(edge.strength);
  const auto last =
      strengths.begin() + static_cast<std::ptrdiff_t>(max_edges - 1);
  std::nth_element(strengths.begin(), last, strengths.end(), std::greater<>());
  return static_cast<std::int32_t>(std::erase_if(
      *edges, [&](const Edge2d& edge) { return edge.strength < *last; }));
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
  std::vector<Contour> contours = Measure(edges, labels);
  const double weak = options.short_contour_factor * min_gradient;
  KeptEdges kept;
  for (Contour& contour : contours) {
    contour.is_kept = contour.num_edges >= options.min_contour_edges ||
                      contour.strength >= weak;
    if (contour.is_kept) continue;
    kept.num_isolated += static_cast<std::int32_t>(contour.num_edges);
  }
  KeepStrongest(options.min_contour_edges, max_edges, contours);
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

}  // namespace curvix
