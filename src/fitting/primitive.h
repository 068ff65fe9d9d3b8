// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). A line, circle, ellipse or spline, whichever.
#pragma once

#include <curvix/fitting.h>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "fitting/fit_conic.h"
#include "fitting/fit_samples.h"
#include "fitting/spline.h"

namespace curvix {

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
