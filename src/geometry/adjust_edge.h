// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Multi-view triangulation of an oriented edge, or of
// an occluding contour.
//
// A 2D edge determines the plane through its camera's centre in which the 3D
// edge lies, but no position along the edge. So the position changes only
// across the tangent: two unknowns, one equation per view.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/directions.h"
#include "geometry/edge_geometry.h"
#include "model/posed_view.h"

namespace curvix {

// One 2D edge as a measurement of a 3D edge.
struct PlaneMeasurement {
  Eigen::Vector3d plane;   // of EdgePlane()
  Eigen::Vector3d center;  // of the camera, world
  Eigen::Vector3d axis;    // depth(X) = axis . (X - center)
};
PlaneMeasurement MeasurePlane(const PosedView& view, const ImageEdge& edge);

// The signed distance of the projection of x from the measured edge, in pixels,
// positive as for EdgePlane(), and its gradient with respect to x.
struct SeenDistance {
  double px = 0;
  Eigen::Vector3d gradient;
};
inline SeenDistance DistanceFrom(const PlaneMeasurement& measured,
                                 const Eigen::Vector3d& x) {
  const Eigen::Vector3d offset = x - measured.center;
  const double depth = measured.axis.dot(offset);
  const double px = measured.plane.dot(offset) / depth;
  return {px, (measured.plane - px * measured.axis) / depth};
}

// Cauchy's weight of a measurement with this residual.
inline double CauchyWeight(double distance_px, double sigma_px) {
  const double r = distance_px / sigma_px;
  return 1 / (1 + r * r);
}

// An estimate and how well it is known: `covariance` of the position across the
// tangent, on the axes `across`, world units squared.
struct EdgeEstimate {
  SpaceEdge edge;
  AcrossAxes across;  // of edge.tangent
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

// Gauss-Newton from `start` on the signed pixel distances to the measurements,
// with weights 1 / (1 + (r / sigma_px)^2) (Cauchy), then the tangent as the
// direction most orthogonal to the planes' normals, with the same weights, and
// to the rays, with `ray_weight` times these: a prior against edges seen
// end-on. The covariance takes sigma_px for the measurements' standard
// deviation, or the residuals' spread where that is larger. Needs two
// measurements whose planes differ; where they hardly do, the covariance is
// large in that direction and the estimate stays near `start`.
EdgeEstimate AdjustEdge(const SpaceEdge& start,
                        const std::vector<PlaneMeasurement>& measurements,
                        double sigma_px,
                        double ray_weight = 0);

// The estimate of AdjustEdge() for two measurements whose planes meet in
// `edge`, so that all residuals are zero; at a quarter of the cost.
EdgeEstimate EstimateAtMeeting(const SpaceEdge& edge,
                               const PlaneMeasurement& measurement1,
                               const PlaneMeasurement& measurement2,
                               double sigma_px);

// The variance, in px^2, of the projection of an estimate across its projected
// tangent. `projected` is ProjectEdge() of the estimate in `view`.
double VarianceAcross(const PosedView& view,
                      const ImageEdge& projected,
                      const EdgeEstimate& estimate);

// A place on an edge or on an occluding contour of a smooth body.
//
// Near its contour, a smooth body is nearly a cylinder. Each view sees the line
// of it that its ray touches; the radius is assumed to be small compared with
// the distance. An edge is a cylinder of radius zero. So one more unknown, the
// radius, covers both cases without a decision between them.
struct OccludingContour {
  SpaceEdge axis;
  double radius = 0;  // world units; negative on the side against `outward`
  // On which side views see the body end; unit, across the axis. Of an edge, it
  // is any.
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
};

// A place of the contour amid those that views see.
Eigen::Vector3d MiddleOf(const OccludingContour& contour);

// The mean of the sides on which cameras at `centers` see the body end, up to
// sign: unit, across the axis.
Eigen::Vector3d MeanSide(const SpaceEdge& axis,
                         const std::vector<Eigen::Vector3d>& centers);

// From the axis to the place of the contour that a camera at `center` sees, for
// a radius of 1: a unit vector across the axis and the ray; zero where the ray
// runs along the axis.
Eigen::Vector3d SideSeenFrom(const OccludingContour& contour,
                             const Eigen::Vector3d& center);

SpaceEdge SeenFrom(const OccludingContour& contour,
                   const Eigen::Vector3d& center);

// Fits axis and radius to what at least two views measure, as AdjustEdge()
// does, from `start`. A very weak prior pulls towards radius 0 if the rays tell
// nothing of it.
OccludingContour AdjustOccludingContour(
    const OccludingContour& start,
    const std::vector<PlaneMeasurement>& measurements,
    double sigma_px);

}  // namespace curvix
