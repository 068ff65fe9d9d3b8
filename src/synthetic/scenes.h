// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Scenes like machine parts, houses and tables;
// those that one walks through, rooms and streets, with the poses of such a
// walk.
#pragma once

#include <curvix/scene.h>
#include <cstdint>
#include <vector>

#include "synthetic/primitive.h"
#include "synthetic/solid.h"
#include "synthetic/synthetic_scene.h"

namespace curvix {

// `solid` centred on the origin, z up, longest side `scale` world units; a
// facade has that height, and the length that `num_views` images need.
// `pattern` is painted on every added body; kMixed: on each what suits it.
//
// For CreaseCurves to know every edge, round faces meet planar ones only, and
// planes meet frustums at right angles to the axis.
Solid MakeSolid(SyntheticSolid solid,
                double scale,
                int num_views = 3,
                SurfacePattern pattern = SurfacePattern::kNone);

// Seen from within, of length one without its walls.
std::vector<SolidPrimitive> Room();

// cam_from_world of photographs taken within the room, which is centred on the
// origin and has this `length` with its walls: all around, each towards the
// opposite wall, at eye level.
std::vector<Rigid3> MakeRoomPoses(int num_views,
                                  double length,
                                  std::uint64_t seed);

// The front of a row of houses, of height one: it looks along -y and is as long
// as a walk along it with `num_views` photographs. Ledges run along all of it;
// doors and windows change from bay to bay.
std::vector<SolidPrimitive> Facade(int num_views);

// cam_from_world of a walk along a facade of this `height`, centred on the
// origin: two photographs from each place, one from below and one from above,
// that look ahead, across and back in turns. A place of the facade is in some
// 20 of them.
std::vector<Rigid3> MakeStreetPoses(int num_views,
                                    double height,
                                    std::uint64_t seed);

}  // namespace curvix
