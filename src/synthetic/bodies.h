// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Primitives by their measures.
#pragma once

#include "synthetic/primitive.h"

#include <Eigen/Core>

namespace curvix {

// What is taken away reaches this far beyond what it is taken from, so that no
// two faces coincide by rounding.
inline constexpr double kBeyond = 0.05;
inline constexpr double kHoleAlbedo = 0.8;  // as if less light came in

SolidPrimitive Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

// From the centre of the base along `axis`.
SolidPrimitive Frustum(const Eigen::Vector3d& base,
                       const Eigen::Vector3d& axis,
                       double base_radius,
                       double top_radius);
SolidPrimitive Cylinder(const Eigen::Vector3d& base,
                        const Eigen::Vector3d& axis,
                        double radius);

SolidPrimitive Sphere(const Eigen::Vector3d& centre, double radius);

// The parallelogram of two sides at right angles that begin at `corner`.
SolidPrimitive FlatSheet(const Eigen::Vector3d& corner,
                         const Eigen::Vector3d& side,
                         const Eigen::Vector3d& other_side);

SolidPrimitive Without(SolidPrimitive primitive, double albedo = 1);

// A hole through a wall between `from` and `to`.
SolidPrimitive Hole(const Eigen::Vector3d& from,
                    const Eigen::Vector3d& to,
                    double radius);

// Turned around the vertical axis through its centre.
SolidPrimitive Turned(double degrees, SolidPrimitive primitive);

SolidPrimitive Painted(SurfacePattern pattern, SolidPrimitive primitive);

}  // namespace curvix
