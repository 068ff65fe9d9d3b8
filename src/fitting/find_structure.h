// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What lines and arcs have in common.
#pragma once

#include <curvix/fitting.h>

namespace curvix {

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

}  // namespace curvix
