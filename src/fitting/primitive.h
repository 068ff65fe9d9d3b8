// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). A line, circle, ellipse or spline, whichever, and
// the samples that it is fitted to.
#pragma once

#include <curvix/curves.h>
#include <curvix/fitting.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

struct FitSample {
  Eigen::Vector3d position;
  double sigma = 0;   // > 0
  double common = 0;  // of it, what all samples of a curve share; >= 0
  double pixel = 0;   // how long a pixel is there; 0: not known
  // Its errors, across the curve; the common ones included.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  CurveKind kind = CurveKind::kUnknown;
};

// A curve or a part of one, in order; and a view of it.
using FitSamples = std::vector<FitSample>;
using FitSpan = std::span<const FitSample>;

// Of a curve of two samples or more, with the standard deviations that
// FitCurves describes.
FitSamples MakeSamples(const Curve& curve, const std::vector<PosedView>& views);

// Standard deviation of a bent primitive from what its samples share, which
// does not fall with their number: a circle whose edges all lie inside is too
// small.
inline double SharedSigma(const FitSamples& samples) {
  double sum = 0;
  for (const FitSample& s : samples) sum += s.common;
  return sum / static_cast<double>(samples.size());
}

// From here on, in standard deviations, a sample is an outlier.
constexpr double kOutlierSigmas = 3;

// Of every sample, as if none were an outlier.
inline std::vector<double> EqualWeights(FitSpan samples) {
  std::vector<double> weights;
  weights.reserve(samples.size());
  for (const FitSample& s : samples) weights.push_back(1 / (s.sigma * s.sigma));
  return weights;
}

// Of samples with weights.
struct MeanAndScatter {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  // About the mean; only the lower triangle, which eigensolvers read.
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
};

inline MeanAndScatter WeightedScatter(FitSpan samples,
                                      const std::vector<double>& weights) {
  MeanAndScatter result;
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum += weights[i];
    result.mean += weights[i] * samples[i].position;
  }
  result.mean /= sum;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3d offset = samples[i].position - result.mean;
    for (int row = 0; row < 3; ++row) {
      for (int col = 0; col <= row; ++col) {
        result.scatter(row, col) += weights[i] * offset(row) * offset(col);
      }
    }
  }
  return result;
}

// Rounds of reweighting in which the limit for outliers comes down to
// kOutlierSigmas, so that a first fit that outliers have pulled away finds
// back.
constexpr int kNumRounds = 8;

// Weight of a sample in round 0, 1, ..., kNumRounds - 1.
inline double RobustWeight(double squared_distance, double sigma, int round) {
  const int doublings = std::max(0, kNumRounds - 3 - round);
  const double scale = kOutlierSigmas * sigma * (1 << doublings);
  const double ratio = 1 + squared_distance / (scale * scale);
  return 1 / (sigma * sigma * ratio * ratio);
}

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

// That describe it, without its ends.
std::size_t NumParameters(const Shape& shape);

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
