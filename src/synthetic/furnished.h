// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Scenes like houses and rooms.
#pragma once

#include "synthetic/primitive.h"

#include <vector>

namespace curvix {

// See SyntheticSolid. Each piece has the pattern that suits it.
std::vector<SolidPrimitive> House();
std::vector<SolidPrimitive> Table();
std::vector<SolidPrimitive> Knobs();

}  // namespace curvix
