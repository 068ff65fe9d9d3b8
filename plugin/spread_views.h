// SPDX-License-Identifier: BSD-3-Clause
// A few views that stand for all of them.
#pragma once

#include <curvix/scene.h>

#include <vector>

namespace curvix {

// Up to `count` views, ascending: the first one, then always the one that looks
// least like those chosen before, by the distance of centres (in units of the
// largest) and the angle of directions; ties go to the smaller index.
std::vector<int> SpreadViews(const Scene& scene, int count);

}  // namespace curvix
