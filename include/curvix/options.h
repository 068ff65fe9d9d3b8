// SPDX-License-Identifier: BSD-3-Clause
// Every parameter of the reconstruction, one struct per stage. The defaults are
// the best that we know how to do; PaperOptions() is the method of the paper.
// Each field has a flag of the same name: docs/options.md.
#pragma once

#include <curvix/curves.h>

namespace curvix {

// Sec. 3, ref. [15].
struct EdgeDetectionOptions {
  // Standard deviation of the Gaussian derivative filters. Pixels, 0.3 to 10.
  double sigma_px = 1.0;
  // Images with more edges than `max_edges_per_megapixel` allows are seen at
  // this many times `sigma_px`, at which texture and noise weigh less. They are
  // sampled at every pixel instead of every half; 1 to 4; 1 sees all images
  // alike.
  double crowded_scale = 1.5;
  // Weakest gradient kept, grey levels per pixel; >= 0. Raised by
  // `noise_factor` where the image is noisy.
  double min_gradient = 1.0;
  // Weakest gradient kept, in standard deviations of the gradient of the
  // image's own noise; >= 0.
  double noise_factor = 5.0;
  // Longest step to the next edge along a contour (Sec. 5). Pixels, > 0.
  double max_neighbor_distance_px = 3.0;
  // Contours, that is chains of mutual neighbours, with fewer edges count as
  // short: they are dropped where they are weak, and first when there are too
  // many edges. Of edges about half a pixel apart, and half as many of those
  // about a pixel apart; >= 1, which makes none short.
  int min_contour_edges = 6;
  // Most edges of an image of a million pixels; n^0.8 times as many of n
  // million pixels, and 20,000 of any image. Contours of images with more are
  // thinned, and those that tell most of structure are kept: strong, straight
  // and not crowded ones; > 0.
  double max_edges_per_megapixel = 25000;
  // Parallel edges that blur has moved apart or together are moved back.
  bool separate_edges = true;
};

// How hypothesis views are chosen (Sec. 3).
enum class ViewSelection {
  kUnusedEdges,  // paper: the pair of views with most unused edges, repeatedly
  kEveryView,    // every view with its best partners, unexplained edges only
};

// Sec. 3, Fig. 3(a), (b).
struct HypothesisOptions {
  ViewSelection view_selection = ViewSelection::kEveryView;
  // Delta gamma: how well an edge is localised. Pixels, > 0.
  double location_tolerance_px = 0.3;
  // Lower limit of the estimated standard deviation of an edge's position. The
  // estimate for the scene is EdgeSketch::edge_sigma_px.
  double EdgeSigmaPx() const { return location_tolerance_px / 2; }
  // Partners of each view with kEveryView; >= 1.
  int num_partners = 4;
  // Smallest and largest angle between the rays of a view pair. Degrees.
  double min_ray_angle_deg = 5.0;
  double max_ray_angle_deg = 60.0;
  // Where sparse points are: how far beyond their depths edges are looked for,
  // in shares of the range of the inverse depths; 0 (paper): anywhere.
  double depth_margin = 0.5;
  // P: with kUnusedEdges, stop when this share of the edges of every view is
  // used. 0..1.
  double used_edges_to_stop = 0.9;
};

// Sec. 4, Fig. 5.
struct ConsolidationOptions {
  // tau_t: longest slide of an H2 edge along its tangent. Pixels, > 0.
  double max_tangent_shift_px = 3.0;
  // Delta theta: largest turn of an H2 edge that makes it meet the epipolar
  // line. Degrees, >= 0.
  double max_turn_deg = 10.0;
  // tau_c: clusters further apart are not merged. Pixels, > 0.
  double max_cluster_distance_px = 1.0;
  // tau_theta: clusters that differ more in direction are not merged. Degrees.
  double max_cluster_angle_deg = 20.0;
  // Standard deviation of the weights of the mean direction. Pixels, > 0.
  double angle_weight_sigma_px = 2.0;
};

// Sec. 3, Fig. 3(c)-(e).
struct ValidationOptions {
  // Largest normal distance of a supporting edge, with kEveryView and of curves
  // that grow. Pixels, > 0.
  double max_distance_px = 1.0;
  // Delta theta_p: largest angle of a supporting edge, also of curves that
  // grow. Degrees, > 0.
  double max_angle_deg = 15.0;
  // M: fewest supporting views besides H1 and H2; >= 1. With kEveryView, more
  // than half of the views on one side will do, H1 and H2 included.
  int min_num_support_views = 2;
  // With kEveryView: least log-likelihood ratio, see
  // docs/stages/sketch.md; natural logarithm, >= 0.
  double min_log_likelihood_ratio = 10.0;
  // With kEveryView: fewest supporting edges, those of the hypothesis views
  // included, that show no stronger 3D edge at another place; >= 0.
  int min_num_exclusive_views = 3;
  // With kEveryView: of views that see nine tenths of the same at a smaller ray
  // angle, one is queried, and of others that are nearer to each other than
  // that, one at each place. Degrees, 0..90; 0: all are.
  double min_view_angle_deg = 0.5;
};

// Sec. 5, Fig. 6.
struct NeighborhoodOptions {
  // lambda of the spread tests mu + lambda * sigma; > 0.
  double max_spread = 1.0;
  // tau_gamma: longest distance between the projections of linked edges.
  // Pixels, > 0.
  double max_projection_distance_px = 6.0;
  // Links that one edge may ask for, the heaviest first; >= 1. Bounds memory;
  // the paper has no limit.
  int max_num_links = 100;
};

// Sec. 5, Fig. 7.
struct AlignmentOptions {
  // 0 leaves the edges where they are.
  int num_iterations = 0;
  // Share of the mean force and torque applied in each iteration. > 0, <= 1.
  double step_size = 0.01;
  // Pull towards the line with the mean direction of both edges, which leaves
  // circles alone; the neighbour's own line (paper) lets them grow.
  bool use_mean_direction = true;
};

// Sec. 6. Lengths in pixels are those of the view that sees the place largest.
struct ConnectivityOptions {
  // Edges nearer together along a curve are made one. Pixels, >= 0; 0 (paper)
  // keeps all.
  double sample_spacing_px = 1.0;
  // Largest angle between connected edges. Degrees, > 0, <= 90.
  double max_angle_deg = 30.0;
  // Longest gap closed between ends that continue each other. Pixels, 0 to 50;
  // 0 (paper) closes none.
  double max_gap_px = 10.0;
  // A piece of a curve nearer to a longer one is drawn once. Pixels, 0 to 20;
  // 0 (paper) keeps all.
  double max_duplicate_distance_px = 1.0;
  // Curves are cut where they turn by more in one place. Degrees, > 0, <= 180;
  // 180 (paper) cuts none.
  double max_corner_deg = 30.0;
  // Shortest curve kept, in pixels of the view that sees it largest; >= 0.
  // Curve refinement needs more, unless a curve joins two junctions.
  double min_length_px = 5.0;
};

// Instead of Secs. 5 and 6, where images are crowded (AreCrowded()): curves
// that grow from 3D edges along the contours of the images.
struct CurveGrowthOptions {
  bool enabled = true;
  // Smallest significance of a curve: the sum of the log-likelihood ratios of
  // its samples, a pixel apart, over the square root of the number of queries
  // of views, times its contrast over that of the scene. >= 0.
  double min_significance = 22.0;
  // Curves whose 2D edges are more crowded than this (Edge2d::crowding, median)
  // are texture, joints of brick or tiles, and dropped unless they are four
  // times as significant as min_significance. No seed is sought from a 2D edge
  // that is more crowded. >= 0; 0: nothing is texture.
  double max_crowding = 0.35;

  bool IsTexture(double crowding) const {
    return max_crowding > 0 && crowding > max_crowding;
  }
};

// Beyond the paper: curves selected, smoothed, fitted and joined.
struct CurveRefinementOptions {
  bool enabled = true;
  // Curves are dropped whose dilution of precision exceeds this: sigma of the
  // curve over that of one 2D edge. The limit is lower for scattered or blurred
  // edges, higher where the views cannot do better. >= 0; 0: none are dropped,
  // blurred or not.
  double max_dilution = 2.5;
  // Curves are dropped as shading edges if this share of their 2D edges, or
  // more, is blurred. With a smaller share, the limit of the dilution of the
  // sharp edges alone is lower in proportion. > 0, <= 1; 1: blur is no reason
  // to drop a curve.
  double max_blurred_share = 0.6;
  // Curves over max_dilution stay, labelled: occluding contours, mostly.
  bool keep_occluding_contours = false;
  // Standard deviation of the weights of the local fits. Pixels, >= 0; 0
  // smooths nothing.
  double smoothing_px = 2.5;
  // Edges that the response curve of the images has moved are moved back.
  bool undo_response_curve = true;
  // Longest gap closed between ends that continue each other at their own
  // curvature, though the images do not show it. Pixels, >= 0; 0 closes none.
  double max_gap_px = 15.0;
  // Curves that touch are told apart and end where they touch, in a junction.
  bool separate_touching = true;
  // Curves are cut where the fitted curve turns by more in one place. Degrees,
  // > 0, <= 180; 180 cuts none.
  double max_corner_deg = 15.0;
  // Shortest curve kept, unless it leads from one junction to another. Pixels
  // of the view that sees it largest; >= 0.
  double min_length_px = 5.0;
  // How far ends are carried on to a corner. Pixels, >= 0; 0 carries none on.
  double junction_reach_px = 7.0;
};

// Beyond the paper: whether curves are creases, boundaries or markings.
struct CurveKindOptions {
  bool enabled = true;
};

// Beyond the paper: which curves to keep. The defaults keep all; on textured
// photographs, higher values leave structure and take texture away.
struct CurveFilterOptions {
  // Shortest curve, in pixels of the views that see it largest; >= 0.
  double min_length_px = 0;
  // Fewest views that support a sample of it, median; >= 0.
  int min_num_views = 0;
  // Least gradient of its 2D edges, grey levels per pixel, median; >= 0.
  double min_contrast = 0;
  // Largest standard deviation across it. Pixels, median; 0: any.
  double max_sigma_px = 0;
  // Mean cosine of the angle between tangents 10 pixels apart: 1 for a line,
  // 1 - 50 / r^2 for a large circle of r pixels, 0 for small ones; 0..1.
  double min_straightness = 0;
  // Kinds of curves: others are cut out. Where the images do not tell the kind,
  // curves stay.
  CurveKindSet kinds = {};
};

// Beyond the paper: curves as lines, arcs, ellipses and splines (fitting.h).
struct CurveFittingOptions {
  // Whether fits are moved so that the structure that is found among them
  // (fitting.h) holds exactly, by at most three standard deviations.
  bool regularize = false;
};

struct RuntimeOptions {
  // Threads; -1 and 0 mean one per core.
  int num_threads = -1;
};

struct Options {
  EdgeDetectionOptions edge_detection;
  HypothesisOptions hypotheses;
  ConsolidationOptions consolidation;
  ValidationOptions validation;
  NeighborhoodOptions neighborhood;
  AlignmentOptions alignment;
  ConnectivityOptions connectivity;
  CurveGrowthOptions curve_growth;
  CurveRefinementOptions curve_refinement;
  CurveKindOptions curve_kinds;
  CurveFilterOptions curve_filter;
  CurveFittingOptions curve_fitting;
  RuntimeOptions runtime;
};

// The method and the values of the paper throughout.
Options PaperOptions();

}  // namespace curvix
