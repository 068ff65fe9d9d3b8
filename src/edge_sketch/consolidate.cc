// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/consolidate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/angles.h"

namespace curvix {
namespace {

// `edge` slid along its tangent onto `line`; nullopt beyond max_shift_px, which
// covers tangents parallel to the line.
std::optional<ImageEdge> Slide(const ImageEdge& edge,
                               const Line2& line,
                               double max_shift_px) {
  const double distance = line.SignedDistance(edge.position);
  const double sine = line.normal.dot(edge.tangent);
  if (!(std::abs(distance) <= max_shift_px * std::abs(sine))) {
    return std::nullopt;
  }
  const double shift = sine == 0 ? 0 : -distance / sine;
  return ImageEdge{edge.position + shift * edge.tangent, edge.tangent};
}

// The tangent turned towards the line's normal by at most max_turn_rad.
Eigen::Vector2d TurnTowardsNormal(const Eigen::Vector2d& tangent,
                                  const Line2& line,
                                  double max_turn_rad) {
  const double sine = line.normal.dot(tangent);
  const double cosine = line.Direction().dot(tangent);
  const double angle = std::atan2(std::abs(sine), std::abs(cosine));
  const double turn = std::min(max_turn_rad, kPi / 2 - angle);
  // Positive turns go from the line's direction away from its normal. Edges
  // parallel to the line turn the same way whatever the signs of both.
  const double sign = sine * cosine > 0 ? -1.0 : 1.0;
  return Eigen::Rotation2Dd(sign * turn) * tangent;
}

}  // namespace

std::optional<ImageEdge> SlideToLine(const ImageEdge& edge,
                                     const Line2& line,
                                     double location_tolerance_px,
                                     const ConsolidationOptions& options) {
  if (auto slid = Slide(edge, line, options.max_tangent_shift_px)) {
    return slid;
  }
  const ImageEdge turned{
      edge.position,
      TurnTowardsNormal(edge.tangent, line, DegToRad(options.max_turn_deg))};
  if (auto slid = Slide(turned, line, options.max_tangent_shift_px)) {
    return slid;
  }
  const double distance = line.SignedDistance(edge.position);
  if (std::abs(distance) > location_tolerance_px) return std::nullopt;
  return ImageEdge{edge.position - distance * line.normal, edge.tangent};
}

namespace {

// Directions are kept as unit vectors at twice their angle, so that 1 and 179
// degrees give 0 and not 90, and opposite tangents are one.
using DoubledDirection = Eigen::Vector2d;

struct Member {
  double along = 0;  // pixels along the line
  DoubledDirection direction;
  std::int32_t edge_idx = 0;
  int next = -1;  // member of the same cluster
};

struct Cluster {
  double center = 0;           // mean of the members' places
  DoubledDirection direction;  // weighted mean
  int first = 0, last = 0;     // members
  int size = 1;
};

DoubledDirection Doubled(const Eigen::Vector2d& t) {
  return {t.x() * t.x() - t.y() * t.y(), 2 * t.x() * t.y()};
}

// The tangent in (-90, 90] degrees.
Eigen::Vector2d Halved(const DoubledDirection& d) {
  if (d.x() >= 0) {
    const double cosine = std::sqrt((1 + d.x()) / 2);
    return {cosine, d.y() / (2 * cosine)};
  }
  const double sine = std::copysign(std::sqrt((1 - d.x()) / 2), d.y());
  return {d.y() / (2 * sine), sine};
}

// Clusters of members that lie on one line; the members outlive it.
class Clustering {
 public:
  Clustering(std::vector<Member>& members, const ConsolidationOptions& options)
      : members_(members),
        max_distance_px_(options.max_cluster_distance_px),
        min_doubled_cosine_(
            std::cos(2 * DegToRad(options.max_cluster_angle_deg))),
        min_cosine_(std::cos(DegToRad(options.max_cluster_angle_deg))),
        sigma_px_(options.angle_weight_sigma_px) {}

  // The clusters of members [begin, end), which are in order along the line and
  // out of reach of all others; in order along the line.
  const std::vector<Cluster>& Agglomerate(int begin, int end) {
    clusters_.clear();
    if (AreOne(begin, end)) {
      clusters_.push_back(ClusterOf(begin, end));
      return clusters_;
    }
    for (int i = begin; i < end; ++i) {
      const Member& member = At(i);
      clusters_.push_back({member.along, member.direction, i, i, 1});
    }
    while (const auto pair = NearestPair()) Merge(pair->first, pair->second);
    return clusters_;
  }

 private:
  Member& At(int i) const { return members_[static_cast<std::size_t>(i)]; }

  // Whether nothing could keep apart any two clusters of these members: all lie
  // near enough, and all directions within half the limit from one of them.
  bool AreOne(int begin, int end) const {
    if (At(end - 1).along - At(begin).along > max_distance_px_) return false;
    for (int i = begin + 1; i < end; ++i) {
      if (At(i).direction.dot(At(begin).direction) < min_cosine_) return false;
    }
    return true;
  }

  Cluster ClusterOf(int begin, int end) const {
    for (int i = begin; i + 1 < end; ++i) At(i).next = i + 1;
    Cluster cluster{
        At(begin).along, At(begin).direction, begin, end - 1, end - begin};
    if (cluster.size > 1) SetMeans(cluster);
    return cluster;
  }

  // The pair (i, j), i < j, of clusters to merge next. Clusters are sorted by
  // center, so partners of i are right behind it.
  std::optional<std::pair<std::size_t, std::size_t>> NearestPair() const {
    std::optional<std::pair<std::size_t, std::size_t>> best;
    double best_distance = max_distance_px_;
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      for (std::size_t j = i + 1; j < clusters_.size(); ++j) {
        const double distance = clusters_[j].center - clusters_[i].center;
        if (distance > best_distance || (best && distance == best_distance)) {
          break;
        }
        if (clusters_[i].direction.dot(clusters_[j].direction) <
            min_doubled_cosine_) {
          continue;
        }
        best = {i, j};
        best_distance = distance;
      }
    }
    return best;
  }

  void Merge(std::size_t i, std::size_t j) {
    Cluster merged = clusters_[i];
    At(merged.last).next = clusters_[j].first;
    merged.last = clusters_[j].last;
    merged.size += clusters_[j].size;
    SetMeans(merged);
    clusters_.erase(clusters_.begin() + static_cast<std::ptrdiff_t>(j));
    clusters_.erase(clusters_.begin() + static_cast<std::ptrdiff_t>(i));
    const auto place = std::ranges::upper_bound(
        clusters_, merged.center, {}, &Cluster::center);
    clusters_.insert(place, merged);
  }

  // Deviation: the paper gives no sigma of the weights; see docs/paper_map.md.
  void SetMeans(Cluster& cluster) const {
    double sum = 0;
    for (int i = cluster.first; i >= 0; i = At(i).next) sum += At(i).along;
    cluster.center = sum / cluster.size;
    DoubledDirection mean = DoubledDirection::Zero();
    for (int i = cluster.first; i >= 0; i = At(i).next) {
      const double distance = (At(i).along - cluster.center) / sigma_px_;
      mean += std::exp(-0.5 * distance * distance) * At(i).direction;
    }
    const double length = mean.norm();
    cluster.direction = length > 0 ? DoubledDirection(mean / length)
                                   : DoubledDirection::UnitX();
  }

  std::vector<Member>& members_;
  std::vector<Cluster> clusters_;  // by center
  double max_distance_px_, min_doubled_cosine_, min_cosine_, sigma_px_;
};

void Append(const Cluster& cluster,
            const std::vector<Member>& members,
            const Line2& line,
            std::vector<int>& order,
            VirtualEdges& result) {
  // Members are in order along the line.
  order.clear();
  for (int i = cluster.first; i >= 0;
       i = members[static_cast<std::size_t>(i)].next) {
    order.push_back(i);
  }
  std::ranges::sort(order);
  result.edges.push_back(
      {{cluster.center * line.Direction() - line.offset * line.normal,
        Halved(cluster.direction)},
       result.members.size(),
       order.size()});
  for (const int i : order) {
    result.members.push_back(members[static_cast<std::size_t>(i)].edge_idx);
  }
}

}  // namespace

VirtualEdges ClusterEdges(const std::vector<LineEdge>& edges,
                          const Line2& line,
                          const ConsolidationOptions& options) {
  std::vector<Member> members;
  members.reserve(edges.size());
  for (const LineEdge& e : edges) {
    members.push_back({line.Direction().dot(e.edge.position),
                       Doubled(e.edge.tangent),
                       e.edge_idx,
                       -1});
  }
  std::ranges::sort(members, {}, [](const Member& member) {
    return std::pair(member.along, member.edge_idx);
  });
  VirtualEdges result;
  result.edges.reserve(members.size());
  result.members.reserve(members.size());
  std::vector<int> order;
  Clustering clustering(members, options);
  // Members further apart than clusters may be never come together.
  for (std::size_t begin = 0, end = 0; begin < members.size(); begin = end) {
    for (end = begin + 1; end < members.size(); ++end) {
      if (members[end].along - members[end - 1].along >
          options.max_cluster_distance_px) {
        break;
      }
    }
    for (const Cluster& cluster : clustering.Agglomerate(
             static_cast<int>(begin), static_cast<int>(end))) {
      Append(cluster, members, line, order, result);
    }
  }
  return result;
}

}  // namespace curvix
