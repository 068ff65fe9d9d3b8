// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Scenes larger than one machine: cut into parts that
// are reconstructed one by one, and put together again.
//
// Planes cut space into cores; each part has one of them and the curves in it.
// A part also gives curves in an `overlap` around its core, and its views are
// chosen for twice that, so curves in the overlap of two parts are nearly the
// same in both. There they are joined.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace curvix {

// A plane that divides a region in two. x lies below it if normal . x < offset.
struct SceneCut {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // unit
  double offset = 0;                                  // world units
  // What is on either side: the cut of that index, or part -1 - value.
  int below = 0;
  int above = 0;
};

struct ScenePart {
  std::vector<int> view_idxs;  // ascending
  // Of these, those that look mainly at the core: each view is one part's own.
  std::vector<int> own_view_idxs;
};

struct ScenePartition {
  double overlap = 0;          // world units, >= 0
  std::vector<SceneCut> cuts;  // the first divides all of space; none: one part
  std::vector<ScenePart> parts;
};

// Parts of at most `max_views_per_part` views (>= 3), as few as suffice, with
// nearly as many own views each, at least three. Views are divided by the
// places that they see (sparse points; without them, a grid at their working
// depth), by recursive bisection across the longest direction. A part has all
// views with at least one place in twenty in its core or within twice the
// overlap around it. The overlap is 25 pixels at the depth of a typical view.
// O(n log n) for n views with points. kInvalidArgument if the scene is none, or
// if so few views are too few to divide it, as where all views see the same:
// then with the fewest that would do.
Result<ScenePartition> PartitionScene(const Scene& scene,
                                      int max_views_per_part);

// The part in whose core `position` is.
int OwnerOf(const ScenePartition& partition, const Eigen::Vector3d& position);

// A curve and the 2D edges behind it.
struct TracedCurve {
  Curve curve;  // EdgeRef::edge_idx: index into `edges`
  std::vector<Edge2d> edges;
};

// What a part gives to its scene.
struct PartResult {
  // Those in its core and the overlap around it, cut there; they name views of
  // the part.
  std::vector<TracedCurve> curves;
  // For the report: edges detected in its own views, and 3D edges in its core.
  std::int64_t num_own_edges_2d = 0;
  std::int64_t num_core_edges_3d = 0;
};

PartResult TakePart(const ScenePartition& partition,
                    int part_idx,
                    const CurveSet& curves,
                    const std::vector<EdgeMap>& edge_maps);

// The curves of PartResult of all parts, wherever they are.
class PartResults {
 public:
  virtual ~PartResults() = default;
  virtual std::size_t NumCurves(int part_idx) const = 0;
  virtual Result<TracedCurve> Read(int part_idx, std::size_t curve_idx) = 0;
};

// The steps of the above.

// A partition as PartitionScene describes it. `places` of each view, at least
// one. kInvalidArgument as there.
Result<ScenePartition> PartitionViews(
    const std::vector<std::vector<Eigen::Vector3d>>& places,
    double overlap,
    int max_views_per_part);

// A cut as the core on one side of it sees it.
struct Border {
  Eigen::Vector3d normal;  // unit
  double offset = 0;
  bool is_above = false;  // the core is
};

// The borders of each part's core, which is convex.
std::vector<std::vector<Border>> CoresOf(const ScenePartition& partition);

// How far `position` is beyond the border of the core that is exceeded most:
// negative inside it, minus infinity without borders. World units.
double DistanceBeyond(const std::vector<Border>& core,
                      const Eigen::Vector3d& position);

// The runs of two samples or more that are at most `overlap` beyond the core,
// in the order of the curves; whole curves stay as they are, others lose their
// junctions.
std::vector<Curve> CutCurves(const std::vector<Curve>& curves,
                             const std::vector<Border>& core,
                             double overlap);

// Calls f(ref) for all support of the curve, in order.
template <typename F>
void ForEachSupport(Curve& curve, const F& f) {
  for (CurveSample& sample : curve.samples) {
    for (EdgeRef& ref : sample.support) f(ref);
  }
}

}  // namespace curvix
