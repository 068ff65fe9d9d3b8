// SPDX-License-Identifier: BSD-3-Clause
// Images with curves, and small ones of a few views that stand for all.
#pragma once

#include <curvix/curves.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <string>
#include <vector>

namespace curvix {

// Up to `count` views, ascending: the first one, then always the one that looks
// least like those chosen before, by the distance of centres (in units of the
// largest) and the angle of directions; ties go to the smaller index.
std::vector<int> SpreadViews(const Scene& scene, int count);

// JPEGs of the ideal pinhole images of some views, without distortion, at most
// `max_size_px` wide and high; black where the image shows nothing. Empty
// for images that cannot be read.
std::vector<std::string> SmallPinholeJpegs(const Scene& scene,
                                           const std::vector<int>& view_idxs,
                                           int max_size_px,
                                           int num_threads);

// A PNG of a view's image, faded, with the curves drawn over it in their
// colours: where edges of the view support them, and thin and pale where none
// does, which is where something hides them or they are wrong. kNotFound or
// kDataLoss if the image cannot be read.
Result<std::string> OverlayPng(const CurveSource& curves,
                               const Scene& scene,
                               int view_idx);

}  // namespace curvix
