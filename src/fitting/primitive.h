// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). A line, circle, ellipse or spline, whichever.
#pragma once

#include <curvix/fitting.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "fitting/fit_samples.h"

namespace curvix {

// center + frame * (a cos t, b sin t, 0). A circle has a = b.
struct Conic {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();  // a rotation
  double a = 1;                                         // >= b > 0
  double b = 1;

  // In the frame: x and y in the plane, z off it.
  Eigen::Vector3d Local(const Eigen::Vector3d& point) const {
    return frame.transpose() * (point - center);
  }
  Eigen::Vector3d At(double t) const;
  // Unit, towards larger t.
  Eigen::Vector3d Tangent(double t) const;
};

// The parameter t, in (-pi, pi], of the point of the conic that is nearest to
// `point`. For ellipses by iteration on the centre of curvature, good to far
// below one part in a million near the ellipse.
double NearestParameter(const Conic& conic, const Eigen::Vector3d& point);

// Of the point from the conic.
double SquaredDistance(const Conic& conic, const Eigen::Vector3d& point);

// The circle with the least robust algebraic error in the plane of the samples:
// quick, and where FitCircle starts. nullopt: fewer than three samples, or they
// lie on a line.
std::optional<Conic> RoughCircle(FitSpan samples);

// The circle or ellipse with the least robust sum of squared distances.
// nullopt: fewer samples than 4 or 6, all nearly on a line, an ellipse with
// axes more than 20 to 1, or no convergence.
std::optional<Conic> FitCircle(FitSpan samples);
std::optional<Conic> FitEllipse(FitSpan samples);

// `conic` moved to fit `samples` as well as it can while its ends, those next
// to the first and the last sample, lie on `start` and `end` where these are
// given, of a circle to 0.05 standard deviations. A circle stays one.
// nullopt: no circle does, but a straight line.
std::optional<Conic> FitThrough(const Conic& conic,
                                FitSpan samples,
                                const std::optional<Eigen::Vector3d>& start,
                                const std::optional<Eigen::Vector3d>& end);

// A clamped cubic B-spline with even knots.
struct Spline {
  std::vector<Eigen::Vector3d> control_points;  // four or more
  std::vector<double> knots;                    // four more, 0 to 1

  Eigen::Vector3d At(double t) const;  // 0 <= t <= 1
};

// The point of a spline at t, from its parts.
Eigen::Vector3d SplineAt(const std::vector<Eigen::Vector3d>& control_points,
                         const std::vector<double>& knots,
                         double t);

// The spline with the least robust sum of squared distances at parameters that
// begin as shares of the samples' length and then slide to the nearest points.
// With `ends`, it starts and ends there exactly. nullopt: fewer samples than
// control points, or no solution.
std::optional<Spline> FitSpline(
    FitSpan samples,
    std::size_t num_control_points,
    const std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& ends);

// Squared distances of the samples from the spline, each near its own place.
std::vector<double> SquaredDistances(const Spline& spline, FitSpan samples);

// Its direction is unit, from the first sample to the last.
using FittedLine = Eigen::ParametrizedLine<double, 3>;

// The line with the least robust sum of squared distances. nullopt: fewer than
// two samples, or all in one place.
std::optional<FittedLine> FitLine(FitSpan samples);

using Shape = std::variant<FittedLine, Conic, Spline>;

// A shape and the samples of the curve that it stands for: `num_samples` from
// `first_sample` on, round a closed curve.
struct Primitive {
  Shape shape;
  std::size_t first_sample = 0;
  std::size_t num_samples = 0;
  bool closed = false;  // a whole conic, or a spline back to its start
};

// The samples of a primitive.
FitSamples SamplesOf(const Primitive& primitive, const FitSamples& curve);

// Squared distances of the samples from the shape.
std::vector<double> SquaredDistances(const Shape& shape, FitSpan samples);

// Squared distances from a shape that is drawn from its first to its last
// sample. Samples may stick out beyond these ends by three standard deviations.
std::vector<double> DistancesFromPart(const Shape& shape, FitSpan samples);

// The sum of squared distances in standard deviations, those of outliers cut
// down to kOutlierSigmas.
double CostOf(const std::vector<double>& squared_distances, FitSpan samples);

// Whether a shape at these distances explains the samples within their
// uncertainty: nine in ten are no outliers, and those are off by a standard
// deviation or less in each of the two axes across the shape, root mean square.
bool Explains(const std::vector<double>& squared_distances, FitSpan samples);

// Angles of the samples on a conic, each within half a turn of the one before.
std::vector<double> UnwrappedAngles(const Conic& conic, FitSpan samples);

// The same conic, its angles rising along the samples.
Conic Directed(const Conic& conic, FitSpan samples);

// Whether samples of an open curve leave less of a conic open than four of
// their steps or a tenth of a radian.
bool GoesRound(const Conic& conic, FitSpan samples);

// The primitives of an open or closed curve of two or more samples, in order,
// as FitCurves describes them, each fitted alone: lines, arcs, ellipses and
// splines. Neighbours share a sample.
std::vector<Primitive> ChoosePrimitives(const FitSamples& curve, bool closed);

// Sets the centre, the axes and the angles of a fit whose `closed`, `start` and
// `end` are known.
void SetConic(const Conic& conic, CurveFit& fit);

}  // namespace curvix
