// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/prominence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace curvix {
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
