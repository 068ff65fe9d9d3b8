// SPDX-License-Identifier: BSD-3-Clause
// Curves as a drawing has them: lines, arcs, ellipses and splines that meet in
// shared points.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <curvix/scene.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <vector>

namespace curvix {

enum class FitKind { kLine, kArc, kEllipse, kSpline };

// One primitive and the samples that it stands for.
struct CurveFit {
  FitKind kind = FitKind::kLine;
  // A whole circle or ellipse, or a spline that ends where it starts.
  bool closed = false;
  // Samples of the curve: `num_samples` from `first_sample` on, which go on at
  // sample 0 of a closed curve. Neighbouring primitives share a sample.
  std::size_t first_sample = 0;
  std::size_t num_samples = 0;
  // What most of these samples are; ties: the first in CurveKind.
  CurveKind curve_kind = CurveKind::kUnknown;
  // World. Equal, to the last bit, to the position of the node, if there is
  // one.
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d end = Eigen::Vector3d::Zero();
  // Index into FittedCurves::nodes, or -1: the end is free.
  int start_node = -1;
  int end_node = -1;
  // Of the ends. An end in a node has the covariance of the node; a free end
  // is uncertain by 4 px along the primitive. 0 if `closed`. World units
  // squared.
  Eigen::Matrix3d start_covariance = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d end_covariance = Eigen::Matrix3d::Zero();

  // kArc, kEllipse: center + cos(t) major + sin(t) minor for t from start_angle
  // to end_angle, which is the larger one; whole: 2 pi apart. Major and minor
  // are at right angles, and of one length for kArc; |major| >= |minor|.
  // The ends lie on the nodes to a small part of `sigma`.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d major = Eigen::Vector3d::UnitX();
  Eigen::Vector3d minor = Eigen::Vector3d::UnitY();
  double start_angle = 0;  // radians, in (-pi, pi]
  double end_angle = 0;

  // kSpline: a clamped cubic B-spline, num_knots = num_control_points + 4, from
  // 0 to 1.
  std::vector<Eigen::Vector3d> control_points;
  std::vector<double> knots;

  // Distances from the primitive of the samples that are within three standard
  // deviations of it, world units; and the share of these samples.
  double rms_residual = 0;
  double max_residual = 0;
  double inlier_share = 0;
  // Standard deviations of the primitive's position across itself, averaged
  // along it, and (kArc) of its radius. They contain the errors of the samples,
  // taken as independent, and, except for lines, the error that the samples
  // share (0.1 px). World units.
  double sigma = 0;
  double radius_sigma = 0;
  // kArc: of the centre, the unit normal (major x minor) and the radius, in
  // this order. It contains the errors of the samples, of which one in 4 px is
  // independent, the error that they share, and the covariances of the nodes.
  // World units and radians.
  Eigen::Matrix<double, 7, 7> arc_covariance =
      Eigen::Matrix<double, 7, 7>::Zero();
};

// The primitives of one curve, in its direction. Never empty.
struct FittedCurve {
  std::vector<CurveFit> fits;
};

// A point in which primitives meet, of one curve or of several.
struct CurveNode {
  struct End {
    std::size_t curve_idx = 0;
    std::size_t fit_idx = 0;
    bool at_end = false;  // else at its start
  };
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  std::vector<End> ends;  // two or more, ascending by curve and fit
  // Of the position. It contains the errors of the samples of the primitives
  // that meet here, of which one in 4 px is independent, and the error that
  // they share (0.1 px). It is larger where the primitives miss each other by
  // more than these errors. World units squared.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

// Names a fit of FittedCurves. Ordered by curve, then fit.
struct FitIndex {
  std::size_t curve_idx = 0;
  std::size_t fit_idx = 0;

  friend bool operator<(const FitIndex& a, const FitIndex& b) {
    return std::tie(a.curve_idx, a.fit_idx) < std::tie(b.curve_idx, b.fit_idx);
  }
};

// What the fits of a group share.
enum class GroupKind {
  kParallel,     // a direction: of lines, and of the axes of arcs
  kCollinear,    // a line
  kConcentric,   // an axis of arcs
  kEqualRadius,  // a radius, of arcs
  kCoplanar,     // a plane
};

// Lines and arcs that agree in something as far as their covariances tell.
struct FitGroup {
  GroupKind kind = GroupKind::kParallel;
  std::vector<FitIndex> fits;  // ascending
  // What they share, the mean weighted by covariances. All but kEqualRadius:
  // the direction or the normal of the plane, unit, of either sign. kCollinear,
  // kConcentric, kCoplanar: a point of the line, the axis or the plane.
  // kEqualRadius: the radius.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double radius = 0;
  // Standard deviation: of the direction (radians, mean of the two ways), the
  // line or axis across itself, the radius, or the distance of the plane.
  double sigma = 0;
  // Sum of the squared distances of the fits from it, in standard deviations,
  // and its degrees of freedom; 0: of a direction that no other fit shares.
  double chi_squared = 0;
  int degrees_of_freedom = 0;
};

// Two groups of parallel fits whose directions are perpendicular.
struct PerpendicularGroups {
  std::size_t first = 0;  // < second; indices into FitStructure::groups
  std::size_t second = 0;
  double chi_squared = 0;  // one degree of freedom
};

// What lines and arcs have in common.
struct FitStructure {
  std::vector<FitGroup> groups;                    // by kind
  std::vector<PerpendicularGroups> perpendicular;  // ascending
};

// The result of FitCurves; `curves` are those of the CurveSet, in its order.
struct FittedCurves {
  std::vector<FittedCurve> curves;
  std::vector<CurveNode> nodes;
  FitStructure structure;
};

// Fits each curve by the primitives that explain its samples with the fewest
// parameters: one line, arc or ellipse, or a chain of lines and arcs, or a
// spline; the least of
//   sum of min(distance^2 / sigma^2, 9) + 2 (number of parameters) log(samples)
// wins, ties go to the earlier kind. Samples further than three standard
// deviations off, as at rounded corners, thus cost the same at any distance.
// So do samples that lie as far beyond the ends of a line, arc or ellipse,
// which are at the first and the last sample: a curve that goes back is two
// lines. An ellipse so round that a circle is within three standard deviations
// is a circle. Sigma is that of each sample (the median where it is not known;
// where it is known nowhere, 1 px, and at most a twentieth of the distance
// between samples) together with the error that samples share, 0.1 px. For
// pixels, `scene` has the views that samples name; without views these two are
// left out. Next to open ends, which corners bend, the second is four times as
// large.
//
// Ends of curves in the same place are one node, joints of a chain too. A node
// lies where its lines and arcs, fitted alone, come nearest to each other, at
// most ten standard deviations from where the curves meet; there itself, if a
// line or arc would get longer or shorter by more than a quarter at this end.
// An end whose line or arc misses it by more than three standard deviations is
// not in the node. Then each primitive is fitted again with its ends in the
// nodes. With options.regularize, nodes, free ends of lines, and arcs then
// move, by at most three standard deviations, so that `structure` holds
// exactly; fits that do not are left out of it, and its chi_squared and
// degrees_of_freedom are those of before. Same result for any number of
// threads. If curves.status() is not ok in the end, the result means nothing.
FittedCurves FitCurves(const CurveSource& curves,
                       const Scene& scene,
                       const CurveFittingOptions& options,
                       int num_threads);
inline FittedCurves FitCurves(const CurveSet& curves,
                              const Scene& scene,
                              const CurveFittingOptions& options,
                              int num_threads) {
  return FitCurves(CurvesInMemory(curves), scene, options, num_threads);
}

// "line", "arc" ("circle" if closed), "ellipse", "spline".
std::string_view KindName(const CurveFit& fit);

// "parallel", "collinear", "concentric", "equal_radius", "coplanar".
std::string_view KindName(GroupKind kind);

// The point at `t` from 0 (start) to 1 (end); equal steps of t are equal angles
// of arcs and ellipses and equal parameters of splines.
Eigen::Vector3d PointAt(const CurveFit& fit, double t);

// kArc, kEllipse: the unit normal, along major x minor.
inline Eigen::Vector3d NormalOf(const CurveFit& fit) {
  return fit.major.cross(fit.minor).normalized();
}

// The length along the primitive. World units; exact for lines and arcs.
double Length(const CurveFit& fit);

}  // namespace curvix
