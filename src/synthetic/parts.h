// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Solids like machine parts.
#pragma once

#include "synthetic/primitive.h"

#include <vector>

namespace curvix {

// See SyntheticSolid.
std::vector<SolidPrimitive> Block();
std::vector<SolidPrimitive> UprightCylinder();
std::vector<SolidPrimitive> Cone();
std::vector<SolidPrimitive> CutSphere();
std::vector<SolidPrimitive> Part();

}  // namespace curvix
