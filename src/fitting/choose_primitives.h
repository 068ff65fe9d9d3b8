// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Which lines, arcs, ellipses and splines a curve is
// made of.
#pragma once

#include <cstddef>
#include <vector>

#include "fitting/primitive.h"

namespace curvix {

// What describes a primitive with two ends, and what neighbours share.
constexpr std::size_t kLineParameters = 6;
constexpr std::size_t kArcParameters = 8;
constexpr std::size_t kNodeParameters = 3;

struct Chain {
  std::vector<Primitive> primitives;
  double residual_cost = 0;
  std::size_t num_parameters = 0;
};

// The chain of lines and arcs with the least cost: residual costs and
// `parameter_cost` for each parameter. Joints are looked for five samples
// apart, at most at 80 places along the curve, and then moved to the best
// sample nearby; ties go to the joint that comes first. No primitive has fewer
// than 10 samples, so that a few bent samples are outliers and no primitive of
// their own. A closed curve is a chain of two or more, or of none at infinite
// cost.
Chain ChainPrimitives(const FitSamples& curve,
                      bool closed,
                      double parameter_cost);

// The primitives of an open or closed curve of two or more samples, in order,
// as FitCurves describes them, each fitted alone. Neighbours share a sample.
std::vector<Primitive> ChoosePrimitives(const FitSamples& curve, bool closed);

}  // namespace curvix
