// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Corrects the shift of parallel edges by blur.
#include "edge_detection/detect_view_edges.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/grid_index.h"
#include "base/median.h"
#include "geometry/detected_edge.h"

namespace curvix {
namespace {

constexpr double kReachBlurs = 4;
constexpr double kMinAcrossBlurs = 1;
constexpr double kMaxAlongSpacings = 1.5;
constexpr double kMinCosine = 0.8;
constexpr float kMaxShiftBlurs = 0.6f;  // closer steps are not told apart
constexpr float kMinDeterminant = 1e-3f;
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

// Two peaks of the gradient: of an edge, at 0, and of the nearest beside it. In
// units of the blur.
struct PeakPair {
  std::size_t edge_idx = 0;
  Eigen::Vector2f normal;  // of the edge, unit
  float place = 0;         // of the other, along the normal
  float height = 1;
  float other_height = 0;  // below 0 if it gets darker
};

// So many pairs are solved at once, for the sake of vector instructions.
constexpr std::size_t kLanes = 8;
using Lanes = Eigen::Array<float, kLanes, 1>;

Lanes Gaussian(const Lanes& x) { return (-0.5f * x.square()).exp(); }

Lanes Limited(const Lanes& shift) {
  return shift.max(-kMaxShiftBlurs).min(kMaxShiftBlurs);
}

// How far the steps behind the edges' own peaks lie from them, if the gradient
// is the sum of two Gaussians that has the two peaks.
Lanes ShiftsOfSteps(const std::array<PeakPair, kLanes>& pairs) {
  Lanes place, height, other_height;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const auto lane = static_cast<Eigen::Index>(k);
    place[lane] = pairs[k].place;
    height[lane] = pairs[k].height;
    other_height[lane] = pairs[k].other_height;
  }
  Lanes step = Lanes::Zero(), other_step = place;
  for (int round = 0; round < kNumRounds; ++round) {
    // How much of each step there is at each peak.
    const Lanes own = Gaussian(step);
    const Lanes from_other = Gaussian(other_step);
    const Lanes at_other = Gaussian(place - step);
    const Lanes own_of_other = Gaussian(place - other_step);
    const Lanes determinant = own * own_of_other - from_other * at_other;
    // The heights of both steps, times the determinant.
    const Lanes a = height * own_of_other - other_height * from_other;
    const Lanes b = other_height * own - height * at_other;
    // Where the slopes of both are each other's opposite, there is the peak.
    const Lanes shift = -other_step * (b * from_other) / (a * own);
    const Lanes other_shift =
        (place - step) * (a * at_other) / (b * own_of_other);
    // Halfway there, where the heights could be told.
    const auto is_solved = (determinant > kMinDeterminant).eval();
    step = is_solved.select((step + Limited(shift)) / 2, step);
    other_step = is_solved.select(
        (other_step + place + Limited(other_shift)) / 2, other_step);
  }
  return step;
}

// Each edge with the nearest parallel edge on either side, as far as the blur
// mixes them.
std::vector<PeakPair> PairPeaks(const std::vector<Edge2d>& edges,
                                double spacing_px,
                                double blur) {
  const double reach = kReachBlurs * blur;
  const double max_along_px = kMaxAlongSpacings * spacing_px;
  const GridIndex index(edges, reach);
  std::vector<PeakPair> pairs;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Edge2d& edge = edges[i];
    const Eigen::Vector2d tangent = TangentAt(edge.angle);
    const Eigen::Vector2d normal(-tangent.y(), tangent.x());
    double ahead = reach, behind = -reach;
    double height_ahead = 0, height_behind = 0;
    index.VisitAround(edge.position, reach, [&](const IndexedEdge& other) {
      const double cosine = tangent.dot(other.tangent.cast<double>());
      if (std::abs(cosine) < kMinCosine) return;
      const auto j = static_cast<std::size_t>(other.edge_idx);
      const Eigen::Vector2d offset = edges[j].position - edge.position;
      if (std::abs(offset.dot(tangent)) > max_along_px) return;
      const double across = offset.dot(normal);
      const double height =
          std::copysign(static_cast<double>(edges[j].strength), cosine);
      if (std::abs(across) < kMinAcrossBlurs * blur) return;
      if (across > 0 && across < ahead) {
        ahead = across;
        height_ahead = height;
      }
      if (across < 0 && across > behind) {
        behind = across;
        height_behind = height;
      }
    });
    const auto append = [&](double across, double height) {
      if (height == 0) return;
      pairs.push_back({i,
                       normal.cast<float>(),
                       static_cast<float>(across / blur),
                       edge.strength,
                       static_cast<float>(height)});
    };
    append(ahead, height_ahead);
    append(behind, height_behind);
  }
  return pairs;
}

}  // namespace

void SeparateEdges(double spacing_px, std::vector<Edge2d>* edges) {
  const double blur = MedianBlur(*edges);
  if (!(blur > 0)) return;
  const std::vector<PeakPair> pairs = PairPeaks(*edges, spacing_px, blur);
  for (std::size_t begin = 0; begin < pairs.size(); begin += kLanes) {
    const std::size_t num_pairs = std::min(kLanes, pairs.size() - begin);
    std::array<PeakPair, kLanes> lanes;
    std::copy_n(&pairs[begin], num_pairs, lanes.begin());
    const Lanes shifts = ShiftsOfSteps(lanes);
    for (std::size_t k = 0; k < num_pairs; ++k) {
      (*edges)[lanes[k].edge_idx].position +=
          blur * static_cast<double>(shifts[static_cast<Eigen::Index>(k)]) *
          lanes[k].normal.cast<double>();
    }
  }
}

}  // namespace curvix
