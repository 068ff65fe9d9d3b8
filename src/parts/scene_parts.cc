// SPDX-License-Identifier: BSD-3-Clause
#include "parts/scene_parts.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "base/count_text.h"
#include "base/infinity.h"
#include "base/median.h"
#include "edge_sketch/view_overlap.h"
#include "geometry/detected_edge.h"
#include "geometry/directions.h"
#include "model/check_input.h"
#include "model/posed_view.h"
#include "model/sample_ranges.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

void Visit(const ScenePartition& partition,
           int node,
           const std::vector<Border>& borders,
           std::vector<std::vector<Border>>& cores) {
  if (node < 0) {
    cores[static_cast<std::size_t>(-1 - node)] = borders;
    return;
  }
  const SceneCut& cut = partition.cuts[static_cast<std::size_t>(node)];
  for (const bool is_above : {false, true}) {
    std::vector<Border> more = borders;
    more.push_back({cut.normal, cut.offset, is_above});
    Visit(partition, is_above ? cut.above : cut.below, more, cores);
  }
}

using Places = std::vector<std::vector<Vector3d>>;

// Of its places that must lie in a part, for a view to belong to it.
constexpr double kMinShare = 0.05;

// Of a part. Parts with fewer are mostly views of others, or have too few to be
// reconstructed.
constexpr int kMinOwnViews = 3;

Vector3d MedianOf(const std::vector<Vector3d>& points) {
  Vector3d median;
  for (int i = 0; i < 3; ++i) {
    std::vector<double> coordinates;
    for (const Vector3d& point : points) coordinates.push_back(point[i]);
    median[i] = Median(std::move(coordinates));
  }
  return median;
}

// Of nine tenths of the points, those nearest to the median: views with wrong
// poses are elsewhere. Unit; ties and signs do not depend on their order.
Vector3d LongestDirection(std::vector<Vector3d> points) {
  const Vector3d median = MedianOf(points);
  std::ranges::sort(points, {}, [&](const Vector3d& point) {
    return std::tuple((point - median).norm(), point.x(), point.y(), point.z());
  });
  points.resize(points.size() - points.size() / 10);
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vector3d& point : points) {
    covariance += (point - mean) * (point - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  return Upright(solver.eigenvectors().col(2).normalized());
}

class Partitioner {
 public:
  Partitioner(const Places& places, double overlap)
      : places_(places), overlap_(overlap) {
    for (const std::vector<Vector3d>& seen : places) {
      centers_.push_back(MedianOf(seen));
    }
  }

  // nullopt if a cut leaves all views on one side.
  std::optional<ScenePartition> Divide(int num_parts) const {
    std::vector<int> all(places_.size());
    std::iota(all.begin(), all.end(), 0);
    ScenePartition partition;
    partition.overlap = overlap_;
    if (!Divide(num_parts, all, all, {}, partition)) return std::nullopt;
    return partition;
  }

 private:
  // `own`: the views to divide. `near`: those that see something around there,
  // within `borders`. False if there is nothing between which to cut.
  bool Divide(int num_parts,
              std::vector<int> own,
              const std::vector<int>& near,
              const std::vector<Border>& borders,
              ScenePartition& partition) const {
    if (num_parts == 1) {
      AddPart(std::move(own), near, partition);
      return true;
    }
    std::vector<Vector3d> centers;
    for (const int i : own) centers.push_back(CenterOf(i));
    const Vector3d normal = LongestDirection(centers);
    const auto place = [&](int i) {
      return std::pair(normal.dot(CenterOf(i)), i);
    };
    std::ranges::sort(own, {}, place);
    const int num_below = num_parts / 2;
    const std::size_t middle = own.size() *
                               static_cast<std::size_t>(num_below) /
                               static_cast<std::size_t>(num_parts);
    if (middle == 0) return false;
    const double low = place(own[middle - 1]).first;
    const double high = place(own[middle]).first;
    const std::size_t cut_idx = partition.cuts.size();
    partition.cuts.push_back({normal, (low + high) / 2, 0, 0});
    for (const bool is_above : {false, true}) {
      std::vector<Border> more = borders;
      more.push_back({normal, (low + high) / 2, is_above});
      const auto split = own.begin() + static_cast<std::ptrdiff_t>(middle);
      std::vector<int> side(is_above ? split : own.begin(),
                            is_above ? own.end() : split);
      const int num_side = is_above ? num_parts - num_below : num_below;
      const int child = num_side == 1
                            ? -1 - static_cast<int>(partition.parts.size())
                            : static_cast<int>(partition.cuts.size());
      (is_above ? partition.cuts[cut_idx].above
                : partition.cuts[cut_idx].below) = child;
      if (!Divide(
              num_side, std::move(side), Near(near, more), more, partition)) {
        return false;
      }
    }
    return true;
  }

  static void AddPart(std::vector<int> own,
                      const std::vector<int>& near,
                      ScenePartition& partition) {
    std::ranges::sort(own);
    ScenePart part;
    std::ranges::set_union(own, near, std::back_inserter(part.view_idxs));
    part.own_view_idxs = std::move(own);
    partition.parts.push_back(std::move(part));
  }

  // Those of `views` that see enough within the borders and around.
  std::vector<int> Near(const std::vector<int>& views,
                        const std::vector<Border>& borders) const {
    std::vector<int> near;
    for (const int i : views) {
      const std::vector<Vector3d>& seen = places_[static_cast<std::size_t>(i)];
      const auto num_near =
          std::ranges::count_if(seen, [&](const Vector3d& place) {
            return DistanceBeyond(borders, place) <= 2 * overlap_;
          });
      const auto num_seen = static_cast<double>(seen.size());
      if (static_cast<double>(num_near) >= kMinShare * num_seen) {
        near.push_back(i);
      }
    }
    return near;
  }

  const Vector3d& CenterOf(int view_idx) const {
    return centers_[static_cast<std::size_t>(view_idx)];
  }

  const Places& places_;
  double overlap_;
  std::vector<Vector3d> centers_;  // of the places of each view
};

int LargestPart(const ScenePartition& partition) {
  std::size_t largest = 0;
  for (const ScenePart& part : partition.parts) {
    largest = std::max(largest, part.view_idxs.size());
  }
  return static_cast<int>(largest);
}

constexpr double kOverlapPx = 25;

// The length that a typical view shows on one pixel, world units.
double TypicalPixel(const std::vector<PosedView>& views,
                    const std::vector<std::vector<Eigen::Vector3d>>& places) {
  std::vector<double> pixels;
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<double> depths;
    for (const Eigen::Vector3d& place : places[i]) {
      depths.push_back(std::max(0.0, views[i].InCamera(place).z()));
    }
    pixels.push_back(Median(std::move(depths)) / views[i].calibration(0, 0));
  }
  return Median(std::move(pixels));
}

// The curve with the edges that it names: those of its samples, in order.
TracedCurve TraceCurve(Curve curve, const std::vector<EdgeMap>& edge_maps) {
  TracedCurve traced{std::move(curve), {}};
  ForEachSupport(traced.curve, [&](EdgeRef& ref) {
    traced.edges.push_back(EdgeOf(ref, edge_maps));
    ref.edge_idx = static_cast<std::int32_t>(traced.edges.size() - 1);
  });
  return traced;
}

}  // namespace

Result<ScenePartition> PartitionViews(const Places& places,
                                      double overlap,
                                      int max_views_per_part) {
  const Partitioner partitioner(places, overlap);
  const int num_views = static_cast<int>(places.size());
  int fewest_views = num_views;  // that would do
  const auto divide = [&](int num_parts) {
    auto partition = partitioner.Divide(num_parts);
    if (!partition) return partition;
    const int largest = LargestPart(*partition);
    fewest_views = std::min(fewest_views, largest);
    if (largest > max_views_per_part) partition.reset();
    return partition;
  };
  // Doubling, then halving: few attempts for any number of parts.
  const int most = std::max(1, num_views / kMinOwnViews);
  int too_few = 0;
  int enough = 1;
  std::optional<ScenePartition> best;
  while (!(best = divide(enough))) {
    if (enough == most) {
      return Status::InvalidArgument(
          "The " + Plural(num_views, "view") +
          " cannot be divided into parts of at most " +
          Plural(max_views_per_part, "view") +
          ", because each also needs the views that overlap it; "
          "--max_views_per_part must be at least " +
          std::to_string(fewest_views));
    }
    too_few = enough;
    enough = std::min(2 * enough, most);
  }
  while (enough - too_few > 1) {
    const int middle = too_few + (enough - too_few) / 2;
    if (auto partition = divide(middle)) {
      best = std::move(partition);
      enough = middle;
    } else {
      too_few = middle;
    }
  }
  return *std::move(best);
}

int OwnerOf(const ScenePartition& partition, const Eigen::Vector3d& position) {
  int node = partition.cuts.empty() ? -1 : 0;
  while (node >= 0) {
    const SceneCut& cut = partition.cuts[static_cast<std::size_t>(node)];
    node = cut.normal.dot(position) < cut.offset ? cut.below : cut.above;
  }
  return -1 - node;
}

std::vector<std::vector<Border>> CoresOf(const ScenePartition& partition) {
  std::vector<std::vector<Border>> cores(partition.parts.size());
  if (!partition.cuts.empty()) Visit(partition, 0, {}, cores);
  return cores;
}

double DistanceBeyond(const std::vector<Border>& core,
                      const Eigen::Vector3d& position) {
  double farthest = -kInfinity;
  for (const Border& border : core) {
    const double above = border.normal.dot(position) - border.offset;
    farthest = std::max(farthest, border.is_above ? -above : above);
  }
  return farthest;
}

std::vector<Curve> CutCurves(const std::vector<Curve>& curves,
                             const std::vector<Border>& core,
                             double overlap) {
  std::vector<Curve> pieces;
  for (Curve curve : curves) {
    const auto is_near = [&](const CurveSample& sample) {
      return DistanceBeyond(core, sample.position) <= overlap;
    };
    std::vector<bool> kept(curve.samples.size());
    std::transform(
        curve.samples.begin(), curve.samples.end(), kept.begin(), is_near);
    std::ranges::move(KeepRanges(std::move(curve), std::move(kept)),
                      std::back_inserter(pieces));
  }
  return pieces;
}

Result<ScenePartition> PartitionScene(const Scene& scene,
                                      int max_views_per_part) {
  CURVIX_RETURN_IF_ERROR(CheckScene(scene));
  const std::vector<PosedView> views = MakePosedViews(scene);
  const auto places = FindPlaces(views, scene.points);
  return PartitionViews(
      places, kOverlapPx * TypicalPixel(views, places), max_views_per_part);
}

PartResult TakePart(const ScenePartition& partition,
                    int part_idx,
                    const CurveSet& curves,
                    const std::vector<EdgeMap>& edge_maps) {
  const auto cores = CoresOf(partition);
  PartResult result;
  for (Curve& curve : CutCurves(curves.curves,
                                cores[static_cast<std::size_t>(part_idx)],
                                partition.overlap)) {
    result.curves.push_back(TraceCurve(std::move(curve), edge_maps));
  }
  const ScenePart& part = partition.parts[static_cast<std::size_t>(part_idx)];
  for (std::size_t i = 0; i < edge_maps.size(); ++i) {
    if (std::ranges::binary_search(part.own_view_idxs, part.view_idxs[i])) {
      result.num_own_edges_2d +=
          static_cast<std::int64_t>(edge_maps[i].edges.size());
    }
  }
  return result;
}

}  // namespace curvix
