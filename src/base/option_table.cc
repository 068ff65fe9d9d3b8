// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The rows; option_text.cc reads and prints them.
#include "base/option_table.h"

#include <utility>

namespace curvix {
namespace {

struct Range {
  double min;
  double max;
  bool min_is_excluded;
};

constexpr Range AtLeast(double min) { return {min, kInfinity, false}; }
constexpr Range Above(double min) { return {min, kInfinity, true}; }
constexpr Range Between(double min, double max) { return {min, max, false}; }
constexpr Range AboveUpTo(double min, double max) { return {min, max, true}; }

using Field = decltype(OptionRow::field);
using Texts = std::vector<std::string>;

// The rows of one struct of Options. A row is one call:
// (field name, field, range, unit, symbol in the paper, help).
class Section {
 public:
  Section(std::string name, std::vector<OptionRow>& rows)
      : name_(std::move(name)), rows_(rows) {}

  void operator()(const char* name,
                  Field field,
                  Range range,
                  const char* unit,
                  const char* symbol,
                  const char* help) {
    rows_.push_back({name_,
                     name,
                     field,
                     range.min,
                     range.max,
                     range.min_is_excluded,
                     {},
                     unit,
                     symbol,
                     help});
  }

  void Switch(const char* name, bool* field, const char* help) {
    (*this)(name, field, Between(0, 1), "", "", help);
  }

  void Choice(const char* name,
              Field field,
              Texts choices,
              const char* symbol,
              const char* help) {
    const double last = static_cast<double>(choices.size()) - 1;
    (*this)(name, field, Between(0, last), "", symbol, help);
    rows_.back().choices = std::move(choices);
  }

 private:
  std::string name_;
  std::vector<OptionRow>& rows_;
};

// Laid out by hand, so that it reads as a table.
// clang-format off

void AddRows(EdgeDetectionOptions& o, Section row) {
  row("sigma_px", &o.sigma_px, Between(0.3, 10), "px", "Sec. 3, ref. [15]",
      "sigma of the Gaussian derivatives");
  row("crowded_scale", &o.crowded_scale, Between(1, 4), "", "",
      "times sigma_px in images with too many edges; 1: the same in all");
  row("min_gradient", &o.min_gradient, AtLeast(0), "grey levels/px",
      "Sec. 3, ref. [15]",
      "weakest gradient kept");
  row("noise_factor", &o.noise_factor, AtLeast(0), "", "",
      "weakest gradient kept, in sigmas of the noise");
  row("max_neighbor_distance_px", &o.max_neighbor_distance_px,
      AboveUpTo(0, 100), "px", "Sec. 5",
      "longest step along a contour");
  row("min_contour_edges", &o.min_contour_edges, AtLeast(1), "", "",
      "shorter contours are dropped if weak");
  row("max_edges_per_megapixel", &o.max_edges_per_megapixel, Above(0), "", "",
      "most edges of 1 megapixel, of n that times n^0.8, at least 20,000; "
      "prominent contours first");
  row.Switch("separate_edges", &o.separate_edges,
      "undo the shift of parallel edges by blur");
}

void AddRows(HypothesisOptions& o, Section row) {
  row.Choice("view_selection", &o.view_selection,
      {"unused_edges", "every_view"}, "Sec. 3",
      "pairs of views: by unused edges, or every view");
  row("location_tolerance_px", &o.location_tolerance_px, AboveUpTo(0, 100),
      "px", "Delta gamma, Sec. 3",
      "error of an edge");
  row("num_partners", &o.num_partners, AtLeast(1), "", "",
      "every_view: partners of a view");
  row("min_ray_angle_deg", &o.min_ray_angle_deg, Between(0, 180), "deg", "",
      "smallest angle between rays of two views");
  row("max_ray_angle_deg", &o.max_ray_angle_deg, AboveUpTo(0, 180), "deg", "",
      "largest angle between rays of two views");
  row("depth_margin", &o.depth_margin, AtLeast(0), "", "",
      "depths beyond the sparse points, share of their range; 0: all");
  row("used_edges_to_stop", &o.used_edges_to_stop, Between(0, 1), "",
      "P, Sec. 3",
      "unused_edges: share of used edges that ends the search");
}

void AddRows(ConsolidationOptions& o, Section row) {
  row("max_tangent_shift_px", &o.max_tangent_shift_px, AboveUpTo(0, 100), "px",
      "tau_t, Sec. 4",
      "longest slide onto the epipolar line");
  row("max_turn_deg", &o.max_turn_deg, Between(0, 90), "deg",
      "Delta theta, Sec. 4",
      "largest turn towards the epipolar line");
  row("max_cluster_distance_px", &o.max_cluster_distance_px, AboveUpTo(0, 100),
      "px", "tau_c, Sec. 4",
      "largest distance of merged clusters");
  row("max_cluster_angle_deg", &o.max_cluster_angle_deg, AboveUpTo(0, 90),
      "deg", "tau_theta, Sec. 4",
      "largest angle of merged clusters");
  row("angle_weight_sigma_px", &o.angle_weight_sigma_px, Above(0), "px",
      "Sec. 4",
      "sigma of the weights of the mean direction");
}

void AddRows(ValidationOptions& o, Section row) {
  row("max_distance_px", &o.max_distance_px, AboveUpTo(0, 100), "px", "",
      "every_view: largest distance of a supporting edge");
  row("max_angle_deg", &o.max_angle_deg, AboveUpTo(0, 90), "deg",
      "Delta theta_p, Sec. 3",
      "largest angle of a supporting edge");
  row("min_num_support_views", &o.min_num_support_views, AtLeast(1), "",
      "M, Sec. 3",
      "fewest supporting views besides H1 and H2");
  row("min_log_likelihood_ratio", &o.min_log_likelihood_ratio, AtLeast(0), "",
      "", "every_view: least log-likelihood ratio");
  row("min_num_exclusive_views", &o.min_num_exclusive_views, AtLeast(0), "", "",
      "every_view: fewest views of exclusive support");
  row("min_view_angle_deg", &o.min_view_angle_deg, Between(0, 90), "deg", "",
      "every_view: least ray angle between views that show the same; of "
      "nearer ones one is queried");
}

void AddRows(NeighborhoodOptions& o, Section row) {
  row("max_spread", &o.max_spread, Above(0), "", "lambda, Sec. 5",
      "links are pruned beyond mean + so many sigma");
  row("max_projection_distance_px", &o.max_projection_distance_px, Above(0),
      "px", "tau_gamma, Sec. 5",
      "largest distance between projections of linked edges");
  row("max_num_links", &o.max_num_links, AtLeast(1), "", "",
      "most links of an edge, heaviest first");
}

void AddRows(AlignmentOptions& o, Section row) {
  row("num_iterations", &o.num_iterations, AtLeast(0), "", "Sec. 5",
      "alignment steps; 0: no alignment");
  row("step_size", &o.step_size, AboveUpTo(0, 1), "", "Sec. 5",
      "share of force and torque applied");
  row.Switch("use_mean_direction", &o.use_mean_direction,
      "pull towards the mean direction");
}

void AddRows(ConnectivityOptions& o, Section row) {
  row("sample_spacing_px", &o.sample_spacing_px, AtLeast(0), "px", "",
      "edges closer along a curve are merged");
  row("max_angle_deg", &o.max_angle_deg, AboveUpTo(0, 90), "deg", "",
      "largest angle between connected edges");
  row("max_gap_px", &o.max_gap_px, Between(0, 50), "px", "",
      "longest gap closed");
  row("max_duplicate_distance_px", &o.max_duplicate_distance_px,
      Between(0, 20), "px", "",
      "parts closer to a longer curve are dropped");
  row("max_corner_deg", &o.max_corner_deg, AboveUpTo(0, 180), "deg", "",
      "curves are cut at corners of more; 180: none");
  row("min_length_px", &o.min_length_px, AtLeast(0), "px", "Sec. 6",
      "shortest curve, where a view sees it largest");
}

void AddRows(CurveGrowthOptions& o, Section row) {
  row.Switch("enabled", &o.enabled,
      "grow curves in crowded images, instead of Secs. 5 and 6");
  row("min_significance", &o.min_significance, AtLeast(0), "", "",
      "smallest significance of a curve");
  row("max_crowding", &o.max_crowding, AtLeast(0), "", "",
      "largest crowding of seeds, and of curves (median) unless they are four "
      "times as significant; 0: any");
}

void AddRows(CurveRefinementOptions& o, Section row) {
  row.Switch("enabled", &o.enabled,
      "select, smooth, fit and join curves");
  row("max_dilution", &o.max_dilution, AtLeast(0), "", "",
      "largest dilution of precision; 0: any");
  row("max_blurred_share", &o.max_blurred_share, AboveUpTo(0, 1), "", "",
      "share of blurred edges that makes a shading edge; 1: none");
  row.Switch("keep_occluding_contours", &o.keep_occluding_contours,
      "keep and label curves over max_dilution");
  row("smoothing_px", &o.smoothing_px, AtLeast(0), "px", "",
      "sigma of the weights of local fits; 0: none");
  row.Switch("undo_response_curve", &o.undo_response_curve,
      "correct edges for the response curve");
  row("max_gap_px", &o.max_gap_px, AtLeast(0), "px", "",
      "longest gap closed in a bend");
  row.Switch("separate_touching", &o.separate_touching,
      "separate curves that touch");
  row("max_corner_deg", &o.max_corner_deg, AboveUpTo(0, 180), "deg", "",
      "fitted curves are cut at corners of more; 180: none");
  row("min_length_px", &o.min_length_px, AtLeast(0), "px", "",
      "shortest curve, except between junctions");
  row("junction_reach_px", &o.junction_reach_px, AtLeast(0), "px", "",
      "longest extension of an end to a corner");
}

void AddRows(CurveKindOptions& o, Section row) {
  row.Switch("enabled", &o.enabled,
      "tell creases, boundaries and markings apart");
}

void AddRows(CurveFilterOptions& o, Section row) {
  row("min_length_px", &o.min_length_px, AtLeast(0), "px", "",
      "shortest curve");
  row("min_num_views", &o.min_num_views, AtLeast(0), "", "",
      "fewest supporting views (median)");
  row("min_contrast", &o.min_contrast, AtLeast(0), "", "",
      "weakest gradient (median), grey levels per pixel");
  row("max_sigma_px", &o.max_sigma_px, AtLeast(0), "px", "",
      "largest sigma across the curve (median); 0: any");
  row("min_straightness", &o.min_straightness, Between(0, 1), "", "",
      "least mean cosine of tangents 10 px apart: 1 for lines");
  row.Choice("kinds", &o.kinds,
      {"crease", "boundary", "marking", "occluding_contour"}, "",
      "kinds to keep; unknown ones stay");
}

void AddRows(CurveFittingOptions& o, Section row) {
  row.Switch("regularize", &o.regularize,
      "make nearly parallel, perpendicular or concentric fits exact");
}

void AddRows(RuntimeOptions& o, Section row) {
  row("num_threads", &o.num_threads, Between(-1, 4096), "", "",
      "threads; -1 or 0: one per core");
}

// clang-format on

}  // namespace

std::vector<OptionRow> OptionTable(Options& options) {
  std::vector<OptionRow> rows;
  AddRows(options.edge_detection, Section("EdgeDetection", rows));
  AddRows(options.hypotheses, Section("Hypotheses", rows));
  AddRows(options.consolidation, Section("Consolidation", rows));
  AddRows(options.validation, Section("Validation", rows));
  AddRows(options.neighborhood, Section("Neighborhood", rows));
  AddRows(options.alignment, Section("Alignment", rows));
  AddRows(options.connectivity, Section("Connectivity", rows));
  AddRows(options.curve_growth, Section("CurveGrowth", rows));
  AddRows(options.curve_refinement, Section("CurveRefinement", rows));
  AddRows(options.curve_kinds, Section("CurveKinds", rows));
  AddRows(options.curve_filter, Section("CurveFilter", rows));
  AddRows(options.curve_fitting, Section("CurveFitting", rows));
  AddRows(options.runtime, Section("", rows));
  return rows;
}

}  // namespace curvix
