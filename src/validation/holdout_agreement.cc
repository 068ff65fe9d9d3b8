// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "validation/holdout_agreement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/median.h"
#include "base/parallel.h"
#include "geometry/edge_geometry.h"
#include "geometry/image_edge.h"
#include "validation/view_index.h"

namespace curvix {
namespace {

// What was seen of some projections; sums of these are independent of order.
struct Tally {
  std::int64_t num_projections = 0;
  std::int64_t num_on_edge_moved = 0;  // of two per projection
  std::vector<double> distances;       // of those on an edge

  void Add(const std::optional<double>& distance, int num_moved) {
    ++num_projections;
    num_on_edge_moved += num_moved;
    if (distance) distances.push_back(*distance);
  }
  void Append(const Tally& other) {
    num_projections += other.num_projections;
    num_on_edge_moved += other.num_on_edge_moved;
    distances.insert(
        distances.end(), other.distances.begin(), other.distances.end());
  }
};

struct Tallies {
  Tally all;
  Tally expected;
};

class ViewTally {
 public:
  ViewTally(const PosedView& view,
            const EdgeMap& edge_map,
            const std::vector<PosedView>& views,
            const std::vector<bool>& is_held_out,
            const HoldoutOptions& options)
      : view_(view), views_(views), shift_px_(options.shift_px) {
    index_.view = &view;
    index_.edges = &edge_map;
    index_.grid = GridIndex(edge_map.edges, 4 * options.max_distance_px);
    gate_ = {options.max_distance_px,
             options.max_distance_px,
             std::cos(DegToRad(options.max_angle_deg))};
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (!is_held_out[i]) used_.push_back(i);
    }
  }

  Tallies Measure(const std::vector<Curve>& curves) const {
    Tallies tallies;
    for (const Curve& curve : curves) {
      for (const CurveSample& sample : curve.samples) Add(sample, &tallies);
    }
    return tallies;
  }

 private:
  void Add(const CurveSample& sample, Tallies* tallies) const {
    const std::optional<ImageEdge> projected =
        ProjectEdge(view_, {sample.position, sample.tangent});
    if (!projected || !view_.Contains(projected->position)) return;
    const std::optional<double> distance = DistanceToEdge(*projected);
    const Eigen::Vector2d across =
        shift_px_ *
        Eigen::Vector2d(-projected->tangent.y(), projected->tangent.x());
    int num_moved = 0;
    for (const Eigen::Vector2d& shift : {across, Eigen::Vector2d(-across)}) {
      const ImageEdge moved{projected->position + shift, projected->tangent};
      if (DistanceToEdge(moved)) ++num_moved;
    }
    tallies->all.Add(distance, num_moved);
    if (IsExpected(sample)) tallies->expected.Add(distance, num_moved);
  }

  std::optional<double> DistanceToEdge(const ImageEdge& expected) const {
    const auto edge_idx = NearestEdge(index_, expected, gate_);
    if (!edge_idx) return std::nullopt;
    const ImageEdge edge =
        ToImageEdge(index_.edges->edges[static_cast<std::size_t>(*edge_idx)]);
    const Eigen::Vector2d offset = edge.position - expected.position;
    return std::abs(offset.x() * edge.tangent.y() -
                    offset.y() * edge.tangent.x());
  }

  // Of the views used, the two in most like direction support the sample.
  bool IsExpected(const CurveSample& sample) const {
    const Eigen::Vector3d direction =
        (view_.center - sample.position).normalized();
    std::pair<double, std::size_t> best(-2, 0), second(-2, 0);
    for (const std::size_t i : used_) {
      const double cosine =
          direction.dot((views_[i].center - sample.position).normalized());
      const std::pair<double, std::size_t> candidate(cosine, i);
      if (cosine > best.first) {
        second = std::exchange(best, candidate);
      } else if (cosine > second.first) {
        second = candidate;
      }
    }
    return IsSupportedBy(sample, best.second) &&
           IsSupportedBy(sample, second.second);
  }

  static bool IsSupportedBy(const CurveSample& sample, std::size_t view_idx) {
    return std::any_of(sample.support.begin(),
                       sample.support.end(),
                       [view_idx](const EdgeRef& ref) {
                         return ref.view_idx ==
                                static_cast<std::int32_t>(view_idx);
                       });
  }

  const PosedView& view_;
  const std::vector<PosedView>& views_;
  double shift_px_;
  ViewIndex index_;
  Gate gate_;
  std::vector<std::size_t> used_;
};

HoldoutAgreement Summarize(Tally tally) {
  HoldoutAgreement agreement;
  agreement.num_projections = tally.num_projections;
  if (tally.num_projections == 0) return agreement;
  const double n = static_cast<double>(tally.num_projections);
  agreement.support = static_cast<double>(tally.distances.size()) / n;
  agreement.chance = static_cast<double>(tally.num_on_edge_moved) / (2 * n);
  if (tally.distances.empty()) return agreement;
  agreement.median_distance_px = Median(std::move(tally.distances));
  return agreement;
}

}  // namespace

HoldoutAgreements MeasureAgreement(const std::vector<Curve>& curves,
                                   const std::vector<PosedView>& views,
                                   const std::vector<EdgeMap>& edge_maps,
                                   const std::vector<bool>& is_held_out,
                                   const HoldoutOptions& options,
                                   int num_threads) {
  std::vector<Tallies> of_view(views.size());
  ParallelFor(views.size(), num_threads, [&](std::size_t i) {
    if (!is_held_out[i]) return;
    of_view[i] = ViewTally(views[i], edge_maps[i], views, is_held_out, options)
                     .Measure(curves);
  });
  Tallies total;
  for (const Tallies& tallies : of_view) {
    total.all.Append(tallies.all);
    total.expected.Append(tallies.expected);
  }
  return {Summarize(std::move(total.all)),
          Summarize(std::move(total.expected))};
}

}  // namespace curvix
