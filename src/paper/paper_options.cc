// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 to 6. The paper's choices and values; docs/paper_map.md lists
// them, with what the paper leaves open.
#include <curvix/options.h>

namespace curvix {

Options PaperOptions() {
  Options options;
  // Also values that equal the defaults today.
  options.edge_detection.crowded_scale = 1;
  options.edge_detection.separate_edges = false;
  options.hypotheses.view_selection = ViewSelection::kUnusedEdges;
  options.hypotheses.location_tolerance_px = 0.3;
  options.hypotheses.used_edges_to_stop = 0.9;
  options.hypotheses.depth_margin = 0;
  options.consolidation.max_tangent_shift_px = 3.0;
  options.consolidation.max_turn_deg = 10.0;
  options.consolidation.max_cluster_distance_px = 1.0;
  options.consolidation.max_cluster_angle_deg = 20.0;
  options.validation.max_angle_deg = 15.0;
  options.validation.min_num_support_views = 4;
  options.neighborhood.max_projection_distance_px = 6.0;
  options.neighborhood.max_num_links = 1000;
  options.alignment.num_iterations = 1000;
  options.alignment.step_size = 0.01;
  options.alignment.use_mean_direction = false;
  options.connectivity.sample_spacing_px = 0;
  options.connectivity.max_gap_px = 0;
  options.connectivity.max_duplicate_distance_px = 0;
  options.connectivity.max_corner_deg = 180;
  options.connectivity.min_length_px = 10;
  options.curve_growth.enabled = false;
  options.curve_refinement.enabled = false;
  options.curve_kinds.enabled = false;
  return options;
}

}  // namespace curvix
