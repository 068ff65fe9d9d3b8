// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What lines and arcs have in common, and fits that
// hold it.
#pragma once

#include <curvix/fitting.h>
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/angles.h"
#include "geometry/directions.h"

namespace curvix {

// The 99.7 % quantile of chi-square, by Wilson and Hilferty's formula.
double ChiSquaredLimit(int degrees_of_freedom);

struct Test {
  double chance = 1;  // that what is unrelated agrees as well; 1: it failed
  double weight = 1;  // what it counts for
};

// The largest `chance` at which the false discovery rate is one in a hundred,
// tests counted by their weight; -1: there is none. By Benjamini and Hochberg's
// rule, with Storey's estimate of the number of unrelated tests: those that
// failed, and one more.
double LargestChance(std::vector<Test> tests);

// A value of one (the first) or two dimensions.
struct UncertainValue {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double bound = 0;  // the largest difference from the mean of its group
  double space = 1;  // in which unrelated values lie: length or area
};

// Values that agree.
struct ValueGroup {
  std::size_t seed = 0;                            // its surest member
  std::vector<std::size_t> members;                // ascending
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // relative to the seed
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double chi_squared = 0;
  int degrees_of_freedom = 0;
};

// Groups of values, as FindStructure describes them, those of one included; in
// the order of seeds. `order`: the values, the surest first. relative(i, seed):
// value i in coordinates that are good near the seed.
std::vector<ValueGroup> FindAgreements(
    const std::vector<std::size_t>& order,
    int num_dimensions,
    const std::function<UncertainValue(std::size_t, std::size_t)>& relative);

// Within these a fit may be said to agree with others: a share of its size, and
// an angle.
constexpr double kNear = 0.01;
constexpr double kNearAngle = DegToRad(kKnownDeg);

// A line or an arc, and how well it is known.
struct LineOrArc {
  FitIndex index;
  const CurveFit* fit = nullptr;
  // Of a line, or the normal of an arc; unit.
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  Eigen::Matrix3d along_covariance = Eigen::Matrix3d::Zero();
  // The middle of a line, or the centre of an arc.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Matrix3d point_covariance = Eigen::Matrix3d::Zero();
  double size = 0;  // length or radius

  bool is_arc() const { return fit->kind == FitKind::kArc; }
  double along_sigma() const { return std::sqrt(along_covariance.trace() / 2); }
};

// Groups of lines and arcs that are parallel, collinear, concentric, coplanar
// or of one radius, and which directions are perpendicular.
//
// A fit belongs to a group if it lies within the 99.7 % quantile of chi-square
// of the group's weighted mean, with the covariances of both, and within 1.5
// degrees or a hundredth of the length of a line or the radius of an arc.
// Directions that are not known to 1.5 degrees have no part. The surest fits
// come first; each joins the nearest group or begins one. Groups whose sum of
// squares is above its quantile lose the fits that are furthest off. Collinear
// and concentric fits are parallel, too; concentric arcs share an axis.
// Coplanar fits have, at least, three points of the plane and as many more as
// chance does not explain.
//
// Many fits are compared with many: of all that agree, those that do so least
// are left out until one in a hundred of what is found comes of unrelated ones,
// whose directions, places and radii are anywhere (LargestChance). The result
// moves with similarity transforms of the world.
FitStructure FindStructure(const FittedCurves& fitted);

// Adds the groups of coplanar fits, as FindStructure describes them. Candidates
// are the planes of arcs and of pairs of lines that meet in a node, the largest
// first; a pair that is in a plane already is none. A group stays if the number
// of candidates times the chance that so many points lie in one of them by
// accident is below a hundredth: of each point but three, the share of `extent`
// that its uncertainty covers, times the points of the group, one of which it
// could be attached to.
void AddPlanes(const std::vector<LineOrArc>& features,
               const FittedCurves& fitted,
               double extent,
               std::vector<FitGroup>& groups);

// Moves nodes, free ends of lines, and arcs, as little as their covariances
// allow (least squares), so that the structure of `fitted` holds: groups share
// what they share, perpendicular directions are at right angles. Lines stay
// between their ends, arcs stay on their nodes. All hold to far below a
// standard deviation.
//
// Nothing moves by more than three standard deviations: fits that would, or end
// where a node would, leave their groups, and all is solved again. In the first
// eight rounds only those leave that move at least half as far as the worst,
// since others may only follow it. If none of them is in a group, those that
// they meet in nodes leave. Groups that are left with one fit are dropped, but
// for directions that are perpendicular to others. Covariances, and those of
// ellipses and splines, which the caller fits to their nodes again, stay.
void Regularize(FittedCurves& fitted);

}  // namespace curvix
