// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whether poses and cameras are better, tested by data
// that did not determine them.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "poses/pose_observation_set.h"
#include "poses/posed_edges.h"

namespace curvix {

// Errors of places and points, fitted anew to the present poses and cameras.
// Pixels.
struct HeldOutErrors {
  // By place: distances from the nearest edges, by query view with one near.
  std::vector<std::map<std::size_t, double>> places;
  // By point and observation, at most 2 px.
  std::vector<std::vector<double>> points;
};

HeldOutErrors MeasureHeldOut(const PoseObservationSet& held_out,
                             const PosedEdges& edges);

// Errors of one place in one view, before and after. Only where an edge is near
// before or after; the other error is then one pixel.
struct ErrorPair {
  std::size_t place_idx = 0;
  std::size_t view_idx = 0;
  double before = 0;
  double after = 0;
};

// By place, then by view.
std::vector<ErrorPair> PairErrors(const HeldOutErrors& before,
                                  const HeldOutErrors& after);

// By how many pixels errors fall: the root of the fall of their mean square, of
// places or of points, whichever is larger; 0 if both rise.
double FallOfErrors(const HeldOutErrors& before, const HeldOutErrors& after);

// Whether a new camera, by which errors fall by `fall_px`, shifts the image too
// far: by more than half a pixel and four times the fall. Poses and structure
// then undo nearly all of the shift. They bend away from what was made with the
// old camera: points, dense models, other images.
bool IsShiftTooLarge(double shift_px, double fall_px);

// Whether poses are good enough. Points: see fit_point.h. Edges: if the errors
// of the places are small, there is nothing to find.
bool PointsFit(const PoseObservationSet& held_out,
               const HeldOutErrors& errors,
               std::size_t num_views);
bool EdgesFit(const HeldOutErrors& errors);

// z of the sum of independent gains: if losses are as likely as gains, z or
// more has a probability of at most exp(-z^2 / 2) (Chernoff's bound). At least
// the sum over the root of the sum of squares; sqrt(2 n log 2) for n equal
// gains. Negative for losses. Zero without gains.
double SignificanceOf(const std::vector<double>& gains);

// Sums the gains of each cell. Cells are assumed to be independent.
class GainsByCell {
 public:
  explicit GainsByCell(const SpaceCells& cells) : cells_(cells) {}

  void Add(const Eigen::Vector3d& position, double gain) {
    gains_[cells_.CellOf(position)] += gain;
  }
  // Those of the same cells.
  void Add(const GainsByCell& other) {
    for (const auto& [cell, gain] : other.gains_) gains_[cell] += gain;
  }
  // The gains over the root of the sum of their squares.
  std::vector<double> Normalized() const;

 private:
  SpaceCells cells_;
  std::map<SpaceCells::Cell, double> gains_;
};

struct HeldOutGains {
  GainsByCell places;
  GainsByCell points;
};

// Significance of the gains of places, of points, and of both together, where
// both have the same weight.
struct SignificanceOfGain {
  double places = 0;
  double points = 0;
  double all = 0;
};

SignificanceOfGain Together(const HeldOutGains& gains);

HeldOutGains CompareErrors(const PoseObservationSet& held_out,
                           const SpaceCells& cells,
                           const HeldOutErrors& before,
                           const HeldOutErrors& after);

// Of losses of places, then of points, where both are finite.
HeldOutGains CompareLosses(const PoseObservationSet& held_out,
                           const SpaceCells& cells,
                           const std::vector<double>& before,
                           const std::vector<double>& after);

// exp(-z^2 / 2) is 1 / 9000. A run tests at most nine times, up to four camera
// models and the whole with up to five sets of cells, so at most one run in a
// thousand accepts a gain by chance.
inline constexpr double kSignificant = 4.267;

// Whether the gain of both together is at least so many standard deviations,
// and neither places nor points contradict it.
bool IsBetter(const SignificanceOfGain& gain, double least = kSignificant);

// Whether neither places nor points show a loss.
bool IsNoWorse(const SignificanceOfGain& gain);

// Whether the gain of the first `num_sets` sets of cells will be significant if
// all other sets gain alike.
bool MayBecomeBetter(const SignificanceOfGain& gain, int num_sets);

// Views in which the errors of the places grow significantly.
std::vector<bool> WorseViews(const std::vector<ErrorPair>& pairs,
                             std::size_t num_views);

}  // namespace curvix
