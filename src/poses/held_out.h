// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whether poses and cameras are better, told by a part
// of space that did not take part in refining them.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "poses/pose_observation_set.h"
#include "poses/posed_edges.h"

namespace curvix {

// Of places and points fitted anew to the poses and cameras as they are.
// Pixels.
struct HeldOutErrors {
  // By place, in its views to ask: from the nearest edge; nothing if none is
  // near.
  std::vector<std::vector<std::optional<double>>> places;
  // By point and observation, cut at 2 px.
  std::vector<std::vector<double>> points;
};

HeldOutErrors MeasureHeldOut(const PoseObservationSet& held_out,
                             int num_threads,
                             const PosedEdges& edges);

// Errors of one place in one view before and after, where an edge is near
// before or after; one pixel where none is.
struct ErrorPair {
  std::size_t place_idx = 0;
  std::size_t view_idx = 0;
  double before = 0;
  double after = 0;
};

std::vector<ErrorPair> PairErrors(const PoseObservationSet& held_out,
                                  const HeldOutErrors& before,
                                  const HeldOutErrors& after,
                                  const PosedEdges& edges);

// Gains of what lies in one cell add up. Cells are taken to be independent.
class GainsByCell {
 public:
  explicit GainsByCell(const SpaceCells& cells) : cells_(cells) {}

  void Add(const Eigen::Vector3d& position, double gain) {
    gains_[cells_.CellOf(position)] += gain;
  }
  double Sum() const;
  // The sum over the root of the sum of squares. If losses were as likely as
  // gains, z or more would come out with a probability of exp(-z^2 / 2) at
  // most. Zero without gains.
  double Significance() const;

 private:
  const SpaceCells& cells_;
  std::map<SpaceCells::Cell, double> gains_;
};

// Significance() of the gains of places, of points, and of both together: the
// sum over the root of their number.
struct SignificanceOfGain {
  double places = 0;
  double points = 0;
  double all = 0;
};

SignificanceOfGain Together(const GainsByCell& places,
                            const GainsByCell& points);

SignificanceOfGain CompareErrors(const PoseObservationSet& held_out,
                                 const SpaceCells& cells,
                                 const HeldOutErrors& before,
                                 const HeldOutErrors& after,
                                 const PosedEdges& edges);

// exp(-z^2 / 2) is 1 / 5000: more is no chance. A run judges five times at
// most, each of up to four camera models and then the whole, and so takes
// chance for a gain in one of a thousand runs at most.
inline constexpr double kSignificant = 4.127;

// Whether the gain is no chance, and neither places nor points tell the
// contrary.
bool IsBetter(const SignificanceOfGain& gain);

// Whether neither places nor points tell that the gain is a loss.
bool IsNoWorse(const SignificanceOfGain& gain);

// Views in which the places come away from their edges, and hardly by chance.
std::vector<bool> WorseViews(const std::vector<ErrorPair>& pairs,
                             std::size_t num_views);

}  // namespace curvix
