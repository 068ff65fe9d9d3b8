// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The standard deviation of 2D edges in a scene.
#include "edge_sketch/sketch_by_views.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/median.h"
#include "geometry/adjust_edge.h"

namespace curvix {
namespace {

// In all views that overlap another.
constexpr std::size_t kNumQueryEdges = 4000;
// The sketch must see larger distances than it expects.
constexpr double kPilotSigmas = 2;
constexpr std::size_t kMinNumSupports = 4;
// A place across a contour, its radius; fewer than the supports.
constexpr double kNumParameters = 3;
constexpr std::size_t kMinNumDistances = 100;

// Of the supports of `edge` from the contour that agrees best with all of them,
// as large as they would be from the true one. On an edge the radius is zero,
// and occluding contours of smooth bodies do not count as noise.
void AddDistances(const Edge3d& edge,
                  const SketchInput& input,
                  double sigma_px,
                  std::vector<double>& distances_px) {
  const std::vector<PlaneMeasurement> measurements =
      MeasurePlanes(edge.support, input.indices);
  OccludingContour start;
  start.axis = {edge.position, edge.tangent};
  const OccludingContour contour =
      AdjustOccludingContour(start, measurements, sigma_px);
  const double n = static_cast<double>(measurements.size());
  for (const PlaneMeasurement& m : measurements) {
    const double px = DistanceFrom(m, SeenFrom(contour, m.center).position).px;
    distances_px.push_back(std::abs(px) * std::sqrt(n / (n - kNumParameters)));
  }
}

}  // namespace

double EstimateEdgeSigma(const SketchInput& input, const StepDone& step_done) {
  const double least_px = input.sigma_px;
  std::size_t num_edges = 0;
  for (std::size_t i = 0; i < input.edge_maps.size(); ++i) {
    if (input.distinct.overlaps[i].empty()) continue;
    num_edges += input.edge_maps[i].edges.size();
  }
  SketchInput pilot = input;
  pilot.sigma_px = kPilotSigmas * least_px;
  pilot.h1_step = std::max<std::size_t>(1, num_edges / kNumQueryEdges);
  const EdgeSketch sketch =
      SketchByViews(pilot, [&](int, int total) { return step_done(0, total); });
  std::vector<double> distances_px;
  for (const Edge3d& edge : sketch.edges) {
    if (edge.support.size() < kMinNumSupports) continue;
    AddDistances(edge, input, pilot.sigma_px, distances_px);
  }
  if (distances_px.size() < kMinNumDistances) return least_px;
  const double sigma_px = kSigmasPerMedian * Median(std::move(distances_px));
  // Rounded, so that the last bits of sums make no difference.
  return std::max(least_px, std::round(sigma_px * 1000) / 1000);
}

}  // namespace curvix
