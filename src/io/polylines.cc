// SPDX-License-Identifier: BSD-3-Clause
#include "io/polylines.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>

namespace curvix {
namespace {

using Edges = std::vector<std::array<std::size_t, 2>>;

// A path through the graph. If it comes back to its first vertex it is closed
// and does not repeat it.
struct Path {
  std::vector<std::size_t> vertices;
  bool closed = false;
  std::size_t first_edge = 0;  // the smallest number among its edges
};

Status Check(const LineGraph& graph) {
  for (std::size_t i = 0; i < graph.positions.size(); ++i) {
    if (graph.positions[i].allFinite()) continue;
    return Status::DataLoss("vertex " + std::to_string(i) +
                            ", counted from 0, has a coordinate that is not "
                            "finite; export the lines again");
  }
  const auto size = static_cast<std::int64_t>(graph.positions.size());
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    for (const std::int64_t vertex : graph.edges[i]) {
      if (vertex >= 0 && vertex < size) continue;
      return Status::DataLoss("edge " + std::to_string(i) + " names vertex " +
                              std::to_string(vertex) +
                              ", counted from 0, but there are " +
                              std::to_string(size) + "; the file is damaged");
    }
  }
  return {};
}

// The edges in their order, each pair of different vertices once.
Edges DistinctEdges(const LineGraph& graph) {
  using Key = std::pair<std::array<std::size_t, 2>, std::size_t>;
  std::vector<Key> keys;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto a = static_cast<std::size_t>(graph.edges[i][0]);
    const auto b = static_cast<std::size_t>(graph.edges[i][1]);
    if (a != b) keys.push_back({{std::min(a, b), std::max(a, b)}, i});
  }
  std::ranges::sort(keys);
  const auto same = [](const Key& a, const Key& b) {
    return a.first == b.first;
  };
  keys.erase(std::unique(keys.begin(), keys.end(), same), keys.end());
  std::vector<std::size_t> kept;
  for (const Key& key : keys) kept.push_back(key.second);
  std::ranges::sort(kept);

  Edges edges;
  for (const std::size_t i : kept) {
    edges.push_back({static_cast<std::size_t>(graph.edges[i][0]),
                     static_cast<std::size_t>(graph.edges[i][1])});
  }
  return edges;
}

// Walks along each edge once.
class Walker {
 public:
  Walker(std::size_t num_vertices, const Edges& edges)
      : edges_(edges), begin_(num_vertices + 1, 0), used_(edges.size(), 0) {
    for (const auto& [a, b] : edges) ++begin_[a + 1], ++begin_[b + 1];
    for (std::size_t v = 0; v < num_vertices; ++v) begin_[v + 1] += begin_[v];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    incident_.resize(2 * edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      for (const std::size_t v : edges[e]) incident_[next[v]++] = e;
    }
  }

  std::vector<Path> Run() {
    std::vector<Path> paths;
    for (std::size_t v = 0; v + 1 < begin_.size(); ++v) {
      if (Degree(v) == 2) continue;
      for (std::size_t i = begin_[v]; i < begin_[v + 1]; ++i) {
        if (!used_[incident_[i]]) paths.push_back(Walk(v, incident_[i]));
      }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!used_[e]) paths.push_back(Walk(edges_[e][0], e));
    }
    std::ranges::sort(paths, {}, &Path::first_edge);
    return paths;
  }

 private:
  std::size_t Degree(std::size_t v) const { return begin_[v + 1] - begin_[v]; }

  Path Walk(std::size_t start, std::size_t edge) {
    Path path{{start}, false, edge};
    for (std::size_t v = start;;) {
      used_[edge] = 1;
      path.first_edge = std::min(path.first_edge, edge);
      v = edges_[edge][0] == v ? edges_[edge][1] : edges_[edge][0];
      path.closed = v == start;
      if (path.closed) return path;
      path.vertices.push_back(v);
      if (Degree(v) != 2) return path;
      const std::size_t first = incident_[begin_[v]];
      edge = first == edge ? incident_[begin_[v] + 1] : first;
    }
  }

  const Edges& edges_;
  std::vector<std::size_t> begin_;     // per vertex, into incident_
  std::vector<std::size_t> incident_;  // edge numbers, ascending per vertex
  std::vector<char> used_;             // per edge
};

// The direction from the sample before `i` to the one after it.
Eigen::Vector3d Chord(const Curve& curve, std::size_t i) {
  const std::size_t n = curve.samples.size();
  const std::size_t before = i > 0 ? i - 1 : (curve.closed ? n - 1 : 0);
  const std::size_t after = i + 1 < n ? i + 1 : (curve.closed ? 0 : i);
  return curve.samples[after].position - curve.samples[before].position;
}

Curve MakeCurve(const LineGraph& graph, const Path& path) {
  Curve curve;
  curve.closed = path.closed;
  curve.samples.resize(path.vertices.size());
  for (std::size_t i = 0; i < path.vertices.size(); ++i) {
    curve.samples[i].position = graph.positions[path.vertices[i]];
    if (graph.kinds.empty()) continue;
    std::tie(curve.samples[i].kind, curve.samples[i].kind_probability) =
        graph.kinds[path.vertices[i]];
  }
  for (std::size_t i = 0; i < path.vertices.size(); ++i) {
    Eigen::Vector3d tangent = Eigen::Vector3d::Zero();
    if (!graph.tangents.empty()) tangent = graph.tangents[path.vertices[i]];
    const Eigen::Vector3d along = Chord(curve, i);
    if (!tangent.allFinite() || tangent.norm() == 0) tangent = along;
    // The file may have the curve in the other direction.
    if (tangent.dot(along) < 0) tangent = -tangent;
    if (tangent.norm() > 0) curve.samples[i].tangent = tangent.normalized();
  }
  return curve;
}

}  // namespace

Result<CurveSet> JoinPolylines(const LineGraph& graph) {
  CURVIX_RETURN_IF_ERROR(Check(graph));
  const Edges edges = DistinctEdges(graph);
  CurveSet curves;
  for (const Path& path : Walker(graph.positions.size(), edges).Run()) {
    curves.curves.push_back(MakeCurve(graph, path));
  }
  return curves;
}

}  // namespace curvix
