// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The planes of elevations and plans.
#pragma once

#include <curvix/fitting.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace curvix {

// Space seen along -toward, from infinitely far away. `right`, `up` and
// `toward` are unit and right-handed.
struct DrawingPlane {
  std::string name;                                  // "xz"
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Eigen::Vector3d toward = Eigen::Vector3d::UnitZ();  // the viewer
  // The normal along which depths grow: `toward` or its opposite.
  Eigen::Vector3d depth_axis = Eigen::Vector3d::UnitZ();
  std::string depth_name = "depth";  // "y" in the xz plane
  bool is_from_behind = false;  // seen from the other side than AxisPlane()

  // x on the paper: (right, up, 0).
  Eigen::Vector3d Flat(const Eigen::Vector3d& x) const {
    return {right.dot(x - origin), up.dot(x - origin), 0};
  }
  double Depth(const Eigen::Vector3d& x) const {
    return depth_axis.dot(x - origin);
  }
};

// "xy": the plan, seen from above; "xz": the front, seen along y; "yz": the
// side, seen against x. Coordinates on the paper are those that the name names,
// depth is the third. nullopt: another name.
std::optional<DrawingPlane> AxisPlane(std::string_view name);

// The same plane from its other side.
DrawingPlane FromBehind(DrawingPlane plane);

// The plane through three points, with its origin in `a`, seen against
// `views_direction`, the way in which cameras look. `up` is up on the paper; in
// a plane within 10 degrees of level, a to b is right. Depth grows towards the
// viewer. kInvalidArgument: the points are on a line.
Result<DrawingPlane> PlaneThrough(const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c,
                                  const Eigen::Vector3d& up,
                                  const Eigen::Vector3d& views_direction);

// Of the planes "xz", "xy" and "yz" of the frame whose axes are the columns of
// `axes`, the one that most views face: those whose optical axes are nearest to
// its normal. Ties go to the one in which more length of lines lies, to 1.5
// degrees, then to the first. Seen from the side of most of these views.
DrawingPlane MainPlane(const FittedCurves& fitted,
                       const Eigen::Matrix3d& axes,
                       const std::vector<View>& views);

// The depth of the wall to look at, from `low` to `high`: the median depth of
// the lines in a slice that has a tenth of the range between the quartiles of
// their depths, by length. Of the slices with nearly the most length, the
// nearest to the viewer. Without lines in the plane, of all primitives; without
// any, the depth in the range that is nearest to 0.
double MainDepth(const FittedCurves& fitted,
                 const DrawingPlane& plane,
                 double low,
                 double high);

}  // namespace curvix
