// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "pipeline/why_empty.h"

#include <cstddef>
#include <cstdint>
#include <sstream>

#include "edge_sketch/track_support.h"
#include "pipeline/sketch_edges.h"

namespace curvix {

std::string WhyEmpty(const std::vector<EdgeMap>& edge_maps,
                     const EdgeSketch& sketch,
                     std::size_t num_curves,
                     const Options& options) {
  std::size_t num_edges = 0;
  std::int64_t num_masked = 0;
  for (const EdgeMap& map : edge_maps) {
    num_edges += map.edges.size();
    num_masked += map.num_dropped_masked;
  }
  const SketchCounts& counts = sketch.counts;
  std::ostringstream text;
  if (num_edges == 0 && num_masked > 0) {
    text << "All " << num_masked
         << " edges are on black pixels of the masks, which are left out. Are "
            "the masks inverted?";
  } else if (num_edges == 0) {
    text << "No edges were found in the " << edge_maps.size()
         << " images. Are they blank or very dark? A lower "
            "--EdgeDetection.min_gradient (now "
         << options.edge_detection.min_gradient << ") finds weaker edges.";
  } else if (counts.view_pairs == 0) {
    text << "No two views overlap with rays between "
         << options.hypotheses.min_ray_angle_deg << " and "
         << options.hypotheses.max_ray_angle_deg
         << " degrees apart, so nothing has depth. Was the camera only "
            "turned? Images from more places help.";
  } else if (counts.hypotheses == 0) {
    text << "None of " << counts.h1_edges
         << " edges has a counterpart on its epipolar line in another view: "
            "the poses may be wrong, or all edges run along the epipolar lines "
            "(images from above and below help).";
  } else if (sketch.edges.empty()) {
    text << "None of " << counts.hypotheses
         << " edge pairs is confirmed by enough other views. Are the poses "
            "right to about a pixel, and do at least "
         << FewestSupports(options.validation, edge_maps.size())
         << " views see each part of the scene?";
  } else if (num_curves > 0) {
    text << "None of " << num_curves
         << " curves passes the filters; lower the --CurveFilter options.";
  } else {
    text << sketch.edges.size() << " 3D edges were found, but no ";
    if (CurvesGrow(edge_maps, options)) {
      text << "curve that grows from them is significant; see edges.ply, or "
              "lower --CurveGrowth.min_significance.";
    } else {
      text << "run of them is " << options.connectivity.min_length_px
           << " pixels long; see edges.ply, or lower "
              "--Connectivity.min_length_px.";
    }
  }
  return text.str();
}

}  // namespace curvix
