// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 4, Fig. 5(c).
#include "consolidation/cluster_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/angles.h"

namespace curvix {
namespace {

// Members are kept by their place along the line.
struct Member {
  double along = 0;  // pixels along the line
  double angle = 0;  // radians
  std::int32_t edge_idx = 0;
};

struct Cluster {
  std::vector<Member> members;
  double center = 0;  // mean of the members' places, pixels along the line
  double angle = 0;   // weighted mean direction, radians, mod pi
};

// Directions are doubled before they are averaged, so that 1 and 179 degrees
// give 0 and not 90. Deviation: the paper gives no sigma; see
// docs/paper_map.md.
double MeanAngle(const std::vector<Member>& members,
                 double center,
                 double sigma_px) {
  double sine = 0, cosine = 0;
  for (const Member& member : members) {
    const double distance = (member.along - center) / sigma_px;
    const double weight = std::exp(-0.5 * distance * distance);
    sine += weight * std::sin(2 * member.angle);
    cosine += weight * std::cos(2 * member.angle);
  }
  return std::atan2(sine, cosine) / 2;
}

Cluster MakeCluster(std::vector<Member> members, double sigma_px) {
  Cluster cluster;
  for (const Member& member : members) cluster.center += member.along;
  cluster.center /= static_cast<double>(members.size());
  cluster.angle = MeanAngle(members, cluster.center, sigma_px);
  cluster.members = std::move(members);
  return cluster;
}

// The pair (i, j), i < j, of clusters to merge next. Clusters are sorted by
// center, so partners of i are right behind it.
std::optional<std::pair<std::size_t, std::size_t>> NearestPair(
    const std::vector<Cluster>& clusters, const ConsolidationOptions& options) {
  std::optional<std::pair<std::size_t, std::size_t>> best;
  double best_distance = options.max_cluster_distance_px;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    for (std::size_t j = i + 1; j < clusters.size(); ++j) {
      const double distance = clusters[j].center - clusters[i].center;
      if (distance > best_distance || (best && distance == best_distance))
        break;
      if (UndirectedDifference(clusters[i].angle, clusters[j].angle) >
          DegToRad(options.max_cluster_angle_deg)) {
        continue;
      }
      best = {i, j};
      best_distance = distance;
    }
  }
  return best;
}

void Merge(std::vector<Cluster>& clusters,
           std::size_t i,
           std::size_t j,
           double sigma_px) {
  std::vector<Member> members = std::move(clusters[i].members);
  members.insert(
      members.end(), clusters[j].members.begin(), clusters[j].members.end());
  clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(j));
  clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(i));
  Cluster merged = MakeCluster(std::move(members), sigma_px);
  const auto place = std::upper_bound(
      clusters.begin(),
      clusters.end(),
      merged.center,
      [](double center, const Cluster& c) { return center < c.center; });
  clusters.insert(place, std::move(merged));
}

VirtualEdge MakeVirtualEdge(Cluster cluster, const Line2& line) {
  std::sort(cluster.members.begin(),
            cluster.members.end(),
            [](const Member& a, const Member& b) {
              return std::pair(a.along, a.edge_idx) <
                     std::pair(b.along, b.edge_idx);
            });
  VirtualEdge result;
  result.edge.position =
      cluster.center * line.Direction() - line.offset * line.normal;
  result.edge.tangent = {std::cos(cluster.angle), std::sin(cluster.angle)};
  for (const Member& member : cluster.members) {
    result.members.push_back(member.edge_idx);
  }
  return result;
}

}  // namespace

std::vector<VirtualEdge> ClusterEdges(std::vector<LineEdge> edges,
                                      const Line2& line,
                                      const ConsolidationOptions& options) {
  const double sigma_px = options.angle_weight_sigma_px;
  std::vector<Cluster> clusters;
  clusters.reserve(edges.size());
  for (const LineEdge& e : edges) {
    const Member member{line.Direction().dot(e.edge.position),
                        std::atan2(e.edge.tangent.y(), e.edge.tangent.x()),
                        e.edge_idx};
    clusters.push_back(MakeCluster({member}, sigma_px));
  }
  std::sort(
      clusters.begin(), clusters.end(), [](const Cluster& a, const Cluster& b) {
        return std::pair(a.center, a.members.front().edge_idx) <
               std::pair(b.center, b.members.front().edge_idx);
      });
  while (const auto pair = NearestPair(clusters, options)) {
    Merge(clusters, pair->first, pair->second, sigma_px);
  }
  std::vector<VirtualEdge> result;
  result.reserve(clusters.size());
  for (Cluster& cluster : clusters) {
    result.push_back(MakeVirtualEdge(std::move(cluster), line));
  }
  return result;
}

}  // namespace curvix
