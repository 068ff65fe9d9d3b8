// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "edge_detection/separate_edges.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/grid_index.h"
#include "base/median.h"

namespace curvix {
namespace {

constexpr double kReachBlurs = 4;
constexpr double kMinAcrossBlurs = 1;
constexpr double kMaxAlongPx = 0.75;
constexpr double kMinCosine = 0.8;
constexpr double kMaxShiftBlurs = 0.6;  // closer steps are not told apart
constexpr int kNumRounds = 6;

// Of edges with a peak; 0 if there are none.
double MedianBlur(const std::vector<Edge2d>& edges) {
  std::vector<double> sharpness;
  for (const Edge2d& edge : edges) {
    if (edge.sharpness > 0) {
      sharpness.push_back(static_cast<double>(edge.sharpness));
    }
  }
  if (sharpness.empty()) return 0;
  return 1 / std::sqrt(Median(std::move(sharpness)));
}

double Gaussian(double x) { return std::exp(-0.5 * x * x); }

// A peak of the gradient; in units of the blur.
struct Peak {
  double place = 0;
  double height = 0;  // below 0 if it gets darker
};

// How far the step behind `peak` lies from it, if the gradient is the sum of
// two Gaussians that has these two peaks.
double ShiftOfStep(const Peak& peak, const Peak& other) {
  double step = peak.place, other_step = other.place;
  for (int round = 0; round < kNumRounds; ++round) {
    const double own = Gaussian(peak.place - step);
    const double from_other = Gaussian(peak.place - other_step);
    const double at_other = Gaussian(other.place - step);
    const double own_of_other = Gaussian(other.place - other_step);
    const double determinant = own * own_of_other - from_other * at_other;
    if (!(determinant > 1e-3)) break;
    const double a =
        (peak.height * own_of_other - other.height * from_other) / determinant;
    const double b =
        (other.height * own - peak.height * at_other) / determinant;
    // Where the slopes of both are each other's opposite, there is the peak.
    const double shift =
        (peak.place - other_step) * (b * from_other) / (a * own);
    const double other_shift =
        (other.place - step) * (a * at_other) / (b * own_of_other);
    const auto halfway = [](double from, double to, double peak_place) {
      return (from + peak_place +
              std::clamp(to, -kMaxShiftBlurs, kMaxShiftBlurs)) /
             2;
    };
    step = halfway(step, shift, peak.place);
    other_step = halfway(other_step, other_shift, other.place);
  }
  return step - peak.place;
}

class Neighborhood {
 public:
  Neighborhood(const std::vector<Edge2d>& edges, double blur)
      : edges_(edges), blur_(blur), index_(edges, kReachBlurs * blur) {}

  Eigen::Vector2d Separated(std::size_t i) const {
    const Edge2d& edge = edges_[i];
    const auto angle = static_cast<double>(edge.angle);
    const Eigen::Vector2d tangent(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d normal(-tangent.y(), tangent.x());
    const double reach = kReachBlurs * blur_;
    Peak ahead{reach, 0}, behind{-reach, 0};
    index_.VisitAround(edge.position, reach, [&](const IndexedEdge& other) {
      const auto j = static_cast<std::size_t>(other.edge_idx);
      const Eigen::Vector2d offset = edges_[j].position - edge.position;
      if (std::abs(offset.dot(tangent)) > kMaxAlongPx) return;
      const double cosine = tangent.dot(other.tangent.cast<double>());
      if (std::abs(cosine) < kMinCosine) return;
      const double across = offset.dot(normal);
      const double height =
          std::copysign(static_cast<double>(edges_[j].strength), cosine);
      if (std::abs(across) < kMinAcrossBlurs * blur_) return;
      if (across > 0 && across < ahead.place) ahead = {across, height};
      if (across < 0 && across > behind.place) behind = {across, height};
    });
    const auto strength = static_cast<double>(edge.strength);
    double shift = 0;
    for (const Peak& other : {ahead, behind}) {
      if (other.height == 0) continue;
      shift += blur_ *
               ShiftOfStep({0, strength}, {other.place / blur_, other.height});
    }
    return edge.position + shift * normal;
  }

 private:
  const std::vector<Edge2d>& edges_;
  double blur_;
  GridIndex index_;
};

}  // namespace

void SeparateEdges(std::vector<Edge2d>* edges) {
  const double blur = MedianBlur(*edges);
  if (!(blur > 0)) return;
  const Neighborhood neighborhood(*edges, blur);
  std::vector<Eigen::Vector2d> separated;
  for (std::size_t i = 0; i < edges->size(); ++i) {
    separated.push_back(neighborhood.Separated(i));
  }
  for (std::size_t i = 0; i < edges->size(); ++i) {
    (*edges)[i].position = separated[i];
  }
}

}  // namespace curvix
