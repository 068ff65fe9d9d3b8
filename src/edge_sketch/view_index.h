// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(c). Views and the means to find their edges.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/grid_index.h"
#include "edge_sketch/edge_density.h"
#include "edge_sketch/evidence.h"
#include "edge_sketch/view_overlap.h"
#include "geometry/adjust_edge.h"
#include "geometry/edge_geometry.h"
#include "geometry/nearest_edge.h"
#include "model/posed_view.h"

namespace curvix {

// What validation needs of a view, made once.
struct ViewIndex {
  const PosedView* view = nullptr;
  const EdgeMap* edges = nullptr;
  GridIndex grid;
  EdgeDensity density;
  AppearanceDensity appearance = {};
  EdgePresence presence = {};  // may be left out
  bool is_repeated = false;    // see DistinctViews
  std::vector<int> before_at_station = {};
};

// `views` by view index.
const Edge2d& EdgeOf(const EdgeRef& ref, const std::vector<ViewIndex>& views);
std::vector<PlaneMeasurement> MeasurePlanes(
    const std::vector<EdgeRef>& support, const std::vector<ViewIndex>& views);

// Where a view may show the edge that supports a 3D edge, relative to the
// projection of the 3D edge. Also the reach of each view's `presence`.
Gate WidestGate(const ValidationOptions& options);

// `widest`, but at most four times `expected_px` (VoteWithSupport()) across.
Gate NarrowGate(const Gate& widest, double expected_px);

// The vote of a view (evidence.h) in which a 3D edge projects to `projected`
// and its edge `support` supports it. `expected_px` is the expected standard
// deviation of the distance between the two.
Vote VoteWithSupport(const ViewIndex& view,
                     const ImageEdge& projected,
                     double expected_px,
                     const Edge2d& support);

// One index per view; the first two vectors must outlive them.
std::vector<ViewIndex> IndexViews(const std::vector<PosedView>& views,
                                  const std::vector<EdgeMap>& edge_maps,
                                  const DistinctViews& distinct,
                                  int num_threads);

// The pixel size at `position` (PixelSizeIn(), world units) in the views of
// `support` that see it largest: the fourth smallest, or, of fewer, the
// largest; infinite without support. In much coarser views neighbouring edges
// are one, or none.
double TypicalPixelSize(const Eigen::Vector3d& position,
                        const std::vector<EdgeRef>& support,
                        const std::vector<ViewIndex>& views);

// Where a view sees `edge`, if it is queried for it: nullopt outside the image,
// where it can show no edge (UnseenCells), in views without edges, where pixels
// are more than twice `pixel_size`, in repeated views, and if one before it at
// its station sees the edge. `pixel_size`: TypicalPixelSize().
std::optional<ImageEdge> ProjectIntoQueryView(
    std::int32_t view_idx,
    const SpaceEdge& edge,
    double pixel_size,
    const std::vector<ViewIndex>& views);

// Adds to each index the `presence` for searches with `options`.
void AddPresence(const ValidationOptions& options,
                 int num_threads,
                 std::vector<ViewIndex>& indices);

// The views of the four stations nearest in direction to each view, nearest
// first, with the weights of their votes. `stations`: see DistinctViews.
NeighborsByView NeighborsInDirection(const Overlaps& overlaps,
                                     const std::vector<int>& stations);

}  // namespace curvix
