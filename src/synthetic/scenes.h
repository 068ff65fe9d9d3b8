// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Scenes like machine parts, houses and tables.
#pragma once

#include <vector>

#include "synthetic/primitive.h"

namespace curvix {

// See SyntheticSolid.
std::vector<SolidPrimitive> Block();
std::vector<SolidPrimitive> UprightCylinder();
std::vector<SolidPrimitive> Cone();
std::vector<SolidPrimitive> CutSphere();
std::vector<SolidPrimitive> Part();

// See SyntheticSolid. Each piece has the pattern that suits it.
std::vector<SolidPrimitive> House();
std::vector<SolidPrimitive> Table();
std::vector<SolidPrimitive> Knobs();

}  // namespace curvix
