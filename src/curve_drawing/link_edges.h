// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 6. The weighted neighborhood graph, step by step: 3D
// edges that share 2D edges or follow each other along image contours are
// linked.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "model/neighborhood_graph.h"
#include "model/posed_view.h"

namespace curvix {

// How far apart two oriented points are, Fig. 6(b)-(d).
// With d from one position to the other, measured against the line of either
// edge; the larger of both values counts, so the order does not matter.
struct EdgeDistances {
  double normal = 0;      // d_n: |d - (d.t)t|, world
  double tangential = 0;  // d_t: |d.t|, world
  double angle = 0;       // between the two lines, radians, in [0, pi/2]
};

// `Oriented` has a position and a unit tangent (Edge3d, CurveSample).
template <typename Oriented>
EdgeDistances MeasureDistances(const Oriented& a, const Oriented& b) {
  const Eigen::Vector3d offset = b.position - a.position;
  const double along_a = offset.dot(a.tangent);
  const double along_b = offset.dot(b.tangent);
  const double normal_a = (offset - along_a * a.tangent).norm();
  const double normal_b = (offset - along_b * b.tangent).norm();
  return {std::max(normal_a, normal_b),
          std::max(std::abs(along_a), std::abs(along_b)),
          std::atan2(a.tangent.cross(b.tangent).norm(),
                     std::abs(a.tangent.dot(b.tangent)))};
}

// Links of shared 2D edges, of which the light ones are pruned by the spread of
// all, united with the lifted tangential links; all are pruned by their
// projections.
// Deviation: the paper prunes by projection before it adds the tangential
// links; these can err as well, where contours of different depth meet in an
// image.
NeighborhoodGraph LinkEdges(const std::vector<Edge3d>& edges,
                            const std::vector<EdgeMap>& edge_maps,
                            const std::vector<PosedView>& views,
                            const NeighborhoodOptions& options,
                            int num_threads);

// Fig. 6(a): links every two 3D edges that are supported by a common 2D edge;
// num_shared is how many they have in common.
//
// Each edge asks for its `options.max_num_links` heaviest links only, the
// nearer and then the smaller index first among equals; a link stays if either
// end asks for it. So there are at most max_num_links links per edge on
// average, however many 3D edges one 2D edge supports.
// Deviation: the paper has no such limit. It drops the lightest links of
// crowded edges, which hardly change the alignment.
//
// Time: the sum over 2D edges of the square of the number of 3D edges that each
// supports.
NeighborhoodGraph BuildGraph(const std::vector<Edge3d>& edges,
                             const NeighborhoodOptions& options,
                             int num_threads);

// Links two 3D edges if one has a 2D edge whose previous or next neighbour
// supports the other; num_tangential is in how many views,
// in the direction that has more.
//
// Each edge asks for its options.max_num_links heaviest links, as in
// BuildGraph. `edge_maps` has one map per view, with the neighbours of each
// edge.
NeighborhoodGraph LinkTangents(const std::vector<Edge3d>& edges,
                               const std::vector<EdgeMap>& edge_maps,
                               const NeighborhoodOptions& options,
                               int num_threads);

// Fig. 6(b)-(d): mu + lambda sigma of each distance over all links of `graph`.
// The same for any number of threads. All zero without links.
EdgeDistances SpreadLimits(const std::vector<Edge3d>& edges,
                           const NeighborhoodGraph& graph,
                           double lambda,
                           int num_threads);

// `graph` without the links of weight one that exceed any of the limits above,
// with lambda = options.max_spread. The paper does not say which links mu and
// sigma are of; here they are of all, since links of weight one are the
// doubtful ones.
NeighborhoodGraph PruneBySpread(const std::vector<Edge3d>& edges,
                                const NeighborhoodGraph& graph,
                                const NeighborhoodOptions& options,
                                int num_threads);

// Fig. 6(e): `graph` without the links whose edges project more than tau_gamma
// = options.max_projection_distance_px apart in any view that sees both. A view
// sees an edge if one of its 2D edges supports it; in other views the edge may
// be hidden. Edges behind a camera that supports them are at an infinite
// distance. Links between edges without a common view stay.
NeighborhoodGraph PruneByProjection(const std::vector<Edge3d>& edges,
                                    const NeighborhoodGraph& graph,
                                    const std::vector<PosedView>& views,
                                    const NeighborhoodOptions& options,
                                    int num_threads);

}  // namespace curvix
