// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 to 6 on one page.
#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/reconstruct.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "base/cancelled.h"
#include "base/count_text.h"
#include "base/infinity.h"
#include "base/option_table.h"
#include "curve_drawing/group_edges.h"
#include "curve_drawing/grow_curves.h"
#include "curve_drawing/link_edges.h"
#include "curve_kinds/classify_curves.h"
#include "curve_refinement/filter_curves.h"
#include "curve_refinement/occluding_contours.h"
#include "curve_refinement/refine_curves.h"
#include "edge_detection/detect_view_edges.h"
#include "edge_sketch/track_support.h"
#include "edge_sketch/view_index.h"
#include "edge_sketch/view_overlap.h"
#include "model/check_input.h"
#include "model/curve_chains.h"
#include "model/posed_view.h"
#include "paper/align_edges.h"
#include "pipeline/run_recorder.h"
#include "pipeline/sketch_edges.h"

namespace curvix {
namespace {

std::int64_t NumEdges(const std::vector<EdgeMap>& edge_maps) {
  std::int64_t num_edges = 0;
  for (const EdgeMap& map : edge_maps) {
    num_edges += static_cast<std::int64_t>(map.edges.size());
  }
  return num_edges;
}

// That have to see a place, at least.
std::size_t FewestViews(const Options& options) {
  const std::size_t num_on_this_side =
      options.hypotheses.view_selection == ViewSelection::kEveryView
          ? 1
          : std::numeric_limits<std::size_t>::max();
  return FewestSupports(options.validation, num_on_this_side);
}

std::string WhyNoPair(const Overlaps& overlaps,
                      const HypothesisOptions& options) {
  double least_deg = kInfinity;  // of those above the limit
  for (const std::vector<ViewOverlap>& others : overlaps) {
    for (const ViewOverlap& overlap : others) {
      const double angle_deg = RadToDeg(overlap.ray_angle_rad);
      if (angle_deg <= options.max_ray_angle_deg) continue;
      least_deg = std::min(least_deg, angle_deg);
    }
  }
  std::ostringstream text;
  text << "No two views overlap with rays between " << options.min_ray_angle_deg
       << " and " << options.max_ray_angle_deg
       << " degrees apart, so nothing has depth. ";
  if (least_deg < kInfinity) {
    text << "Some overlap with rays " << std::floor(least_deg)
         << " degrees apart or more. Images from places in between help.";
  } else {
    text << "Was the camera only turned? Images from more places help.";
  }
  return text.str();
}

// Whether noise raises the gradient that edges need in most images.
bool IsNoiseTheLimit(const std::vector<EdgeMap>& edge_maps,
                     const Options& options) {
  const EdgeDetectionOptions& detection = options.edge_detection;
  const auto num_noisy =
      std::ranges::count_if(edge_maps, [&](const EdgeMap& map) {
        return GradientThreshold(detection, detection.sigma_px, map.noise) >
               detection.min_gradient;
      });
  return 2 * static_cast<std::size_t>(num_noisy) > edge_maps.size();
}

// At which stage everything was lost, and what may help: one or two sentences.
// `num_curves`: before the filters.
std::string WhyEmpty(const Overlaps& overlaps,
                     const std::vector<EdgeMap>& edge_maps,
                     const EdgeSketch& sketch,
                     std::size_t num_curves,
                     const Options& options) {
  std::int64_t num_masked = 0;
  for (const EdgeMap& map : edge_maps) num_masked += map.num_dropped_masked;
  const std::int64_t num_edges = NumEdges(edge_maps);
  const SketchCounts& counts = sketch.counts;
  std::ostringstream text;
  if (num_edges == 0 && num_masked > 0) {
    text << "All edges are on black pixels of the masks ("
         << GroupDigits(num_masked)
         << "), which are left out. Are the masks inverted?";
  } else if (num_edges == 0 && IsNoiseTheLimit(edge_maps, options)) {
    text << "No edges were found above the noise of the "
         << Plural(edge_maps.size(), "image")
         << ". A lower --EdgeDetection.noise_factor (now "
         << options.edge_detection.noise_factor << ") finds weaker edges.";
  } else if (num_edges == 0) {
    text << "No edges were found in the " << Plural(edge_maps.size(), "image")
         << ". Are they blank or very dark? A lower "
            "--EdgeDetection.min_gradient (now "
         << options.edge_detection.min_gradient << ") finds weaker edges.";
  } else if (counts.view_pairs == 0) {
    text << WhyNoPair(overlaps, options.hypotheses);
  } else if (counts.h1_edges == 0) {
    text << "No contour of " << Plural(num_edges, "edge")
         << " is long and clear enough (--EdgeDetection.min_contour_edges), or "
            "all are texture (--CurveGrowth.max_crowding).";
  } else if (counts.hypotheses == 0) {
    text << "None of " << Plural(counts.h1_edges, "edge")
         << " has a counterpart on its epipolar line in another view: "
            "the poses may be wrong, or all edges run along the epipolar lines "
            "(images from above and below help).";
  } else if (sketch.edges.empty()) {
    text << "None of " << Plural(counts.hypotheses, "edge pair")
         << " is confirmed by enough other views. Are the poses "
            "right to about two pixels, and do at least "
         << FewestViews(options) << " views see each part of the scene?";
  } else if (num_curves > 0) {
    text << "None of " << Plural(num_curves, "curve")
         << " passes the filters; lower the --CurveFilter options.";
  } else {
    text << Plural(sketch.edges.size(), "3D edge")
         << OneOrMore(sketch.edges.size(), " was", " were")
         << " found, but no ";
    if (CurvesGrow(edge_maps, options)) {
      text << "curve that grows from them is significant; see edges.ply, or "
              "lower --CurveGrowth.min_significance.";
    } else {
      text << "run of them is " << options.connectivity.min_length_px
           << " px long; see edges.ply, or lower "
              "--Connectivity.min_length_px.";
    }
  }
  return text.str();
}

// Sec. 3 (hypothesise, validate) and Sec. 4 (consolidate).
EdgeSketch Sketch(const Scene& scene,
                  const std::vector<PosedView>& views,
                  const std::vector<EdgeMap>& edge_maps,
                  const Options& options,
                  RunRecorder& run) {
  if (!run.Begin("sketch_edges")) return {};
  EdgeSketch sketch =
      SketchViews(views, edge_maps, scene.points, options, run.Steps());
  run.End(CountsOf(sketch));
  return sketch;
}

// Secs. 5 and 6.
void GroupIntoCurves(const std::vector<PosedView>& views,
                     const std::vector<EdgeMap>& edge_maps,
                     const EdgeSketch& sketch,
                     const Options& options,
                     RunRecorder& run,
                     Reconstruction& result) {
  const int num_threads = options.runtime.num_threads;
  // Sec. 5, Fig. 6.
  if (!run.Begin("link_edges")) return;
  const NeighborhoodGraph graph = LinkEdges(
      sketch.edges, edge_maps, views, options.neighborhood, num_threads);
  run.End({{"links", graph.NumLinks()}});

  // Sec. 5, Fig. 7.
  if (!run.Begin("align_edges")) return;
  result.edges =
      AlignEdges(sketch.edges, graph, options.alignment, num_threads);
  run.End({{"edges", result.edges.size()}});

  // Sec. 6.
  if (!run.Begin("connect_edges")) return;
  result.curves.curves = GroupEdges(result.edges,
                                    graph,
                                    views,
                                    options.connectivity,
                                    num_threads,
                                    run.Steps());
  run.End(CountsOf(result.curves));
}

// Beyond the paper, instead of Secs. 5 and 6: curves grow from 3D edges along
// the contours of the images.
void GrowIntoCurves(const Scene& scene,
                    const std::vector<PosedView>& views,
                    const std::vector<EdgeMap>& edge_maps,
                    const EdgeSketch& sketch,
                    const Options& options,
                    RunRecorder& run,
                    Reconstruction& result) {
  const int num_threads = options.runtime.num_threads;
  if (!run.Begin("grow_curves")) return;
  result.edges = sketch.edges;
  const DistinctViews distinct =
      FindDistinctViews(views, edge_maps, scene.points, options);
  const std::vector<ViewIndex> indices =
      IndexViews(views, edge_maps, distinct, num_threads);
  const auto neighbors =
      NeighborsInDirection(distinct.overlaps, distinct.stations);
  result.curves.curves = GrowCurves(sketch.edges,
                                    {views,
                                     edge_maps,
                                     indices,
                                     neighbors,
                                     sketch.edge_sigma_px,
                                     options.curve_growth,
                                     options.validation},
                                    num_threads,
                                    run.Steps());
  run.End(CountsOf(result.curves));
}

// Secs. 5 and 6 or growth, and what follows beyond the paper.
Result<Reconstruction> Connect(const Scene& scene,
                               const std::vector<PosedView>& views,
                               const std::vector<EdgeMap>& edge_maps,
                               const EdgeSketch& sketch,
                               const Options& options,
                               RunRecorder& run) {
  const int num_threads = options.runtime.num_threads;
  Reconstruction result;
  if (CurvesGrow(edge_maps, options)) {
    GrowIntoCurves(scene, views, edge_maps, sketch, options, run, result);
  } else {
    GroupIntoCurves(views, edge_maps, sketch, options, run, result);
  }

  // Beyond the paper.
  if (!run.Begin("refine_curves")) return CancelledStatus();
  result.curves.curves = RefineCurves(result.curves.curves,
                                      {views,
                                       edge_maps,
                                       sketch.edge_sigma_px,
                                       options.curve_refinement,
                                       num_threads,
                                       run.Steps()});
  run.End(CountsOf(result.curves));

  if (options.curve_kinds.enabled) {
    if (!run.Begin("classify_curves")) return CancelledStatus();
    LabelRoundBars(views,
                   edge_maps,
                   sketch.edge_sigma_px,
                   num_threads,
                   &result.curves.curves);
    ClassifyCurves(
        scene, views, num_threads, &result.curves.curves, run.Steps());
    run.End(KindCounts(result.curves));
  }

  // What the user wants to see of them.
  const std::size_t num_refined = result.curves.curves.size();
  if (!run.Begin("filter_curves")) return CancelledStatus();
  result.curves.curves = FilterCurves(
      std::move(result.curves.curves), views, edge_maps, options.curve_filter);
  IndexJunctions(result.curves);
  run.End(CountsOf(result.curves));

  result.report = run.TakeReport();
  if (result.curves.curves.empty()) {
    result.report.why_empty = WhyEmpty(FindOverlaps(views, scene.points),
                                       edge_maps,
                                       sketch,
                                       num_refined,
                                       options);
  }
  return result;
}

Status Check(const Scene& scene,
             const std::vector<EdgeMap>& edge_maps,
             const Options& options) {
  CURVIX_RETURN_IF_ERROR(CheckScene(scene));
  CURVIX_RETURN_IF_ERROR(CheckEdgeMaps(scene, edge_maps));
  return Validate(options);
}

Result<std::vector<EdgeMap>> Detect(const Scene& scene,
                                    const Options& options,
                                    RunRecorder& run) {
  CURVIX_RETURN_IF_ERROR(CheckScene(scene));
  CURVIX_RETURN_IF_ERROR(Validate(options));
  if (!run.Begin("detect_edges")) return CancelledStatus();
  std::vector<EdgeMap> edge_maps(scene.views.size());
  Status status = run.ForEach(
      edge_maps.size(), options.runtime.num_threads, [&](std::size_t i) {
        const View& view = scene.views[i];
        CURVIX_ASSIGN_OR_RETURN(
            edge_maps[i],
            DetectViewEdges(
                view, CameraOf(scene, view), options.edge_detection));
        return Status();
      });
  if (!status.ok()) return status;
  run.End({{"edges", NumEdges(edge_maps)}});
  return edge_maps;
}

Result<Reconstruction> Reconstruct(const Scene& scene,
                                   const std::vector<EdgeMap>& edge_maps,
                                   const Options& options,
                                   RunRecorder& run) {
  CURVIX_RETURN_IF_ERROR(Check(scene, edge_maps, options));
  const std::vector<PosedView> views = MakePosedViews(scene);
  const EdgeSketch sketch = Sketch(scene, views, edge_maps, options, run);
  return Connect(scene, views, edge_maps, sketch, options, run);
}

}  // namespace

Result<std::vector<EdgeMap>> DetectEdges(const Scene& scene,
                                         const Options& options,
                                         const Progress& progress) {
  RunRecorder run(progress);
  return Detect(scene, options, run);
}

Result<EdgeSketch> SketchEdges(const Scene& scene,
                               const std::vector<EdgeMap>& edge_maps,
                               const Options& options,
                               const Progress& progress) {
  CURVIX_RETURN_IF_ERROR(Check(scene, edge_maps, options));
  RunRecorder run(progress);
  EdgeSketch sketch =
      Sketch(scene, MakePosedViews(scene), edge_maps, options, run);
  if (run.cancelled()) return CancelledStatus();
  return sketch;
}

Result<Reconstruction> CurvesFromSketch(const Scene& scene,
                                        const std::vector<EdgeMap>& edge_maps,
                                        const EdgeSketch& sketch,
                                        const Options& options,
                                        const Progress& progress) {
  CURVIX_RETURN_IF_ERROR(Check(scene, edge_maps, options));
  CURVIX_RETURN_IF_ERROR(CheckEdgeSketch(edge_maps, sketch));
  RunRecorder run(progress);
  return Connect(scene, MakePosedViews(scene), edge_maps, sketch, options, run);
}

Result<Reconstruction> ReconstructCurves(const Scene& scene,
                                         const std::vector<EdgeMap>& edge_maps,
                                         const Options& options,
                                         const Progress& progress) {
  RunRecorder run(progress);
  return Reconstruct(scene, edge_maps, options, run);
}

Result<Reconstruction> ReconstructCurves(const Scene& scene,
                                         const Options& options,
                                         const Progress& progress) {
  RunRecorder run(progress);
  CURVIX_ASSIGN_OR_RETURN(const auto edge_maps, Detect(scene, options, run));
  return Reconstruct(scene, edge_maps, options, run);
}

}  // namespace curvix
