// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What every curve is: crease, boundary or marking.
//
// A surface that begins at a curve leads away from it in one direction across
// it. The strips beside the curve then show the same in all images that see
// it, if they are compared along this direction. One surface on both sides, in
// opposite directions, makes a marking; two directions make a crease; a
// surface on one side only a boundary.
#pragma once

#include <curvix/curves.h>
#include <curvix/scene.h>

#include <vector>

#include "base/cancelled.h"
#include "model/posed_view.h"

namespace curvix {

// Sets kind and probability of every sample, from the images of the scene.
// Curves that are occluding contours already stay so. Where no image can be
// read, or fewer than three views face any surface, samples are kUnknown. One
// view per scene view. `step_done` counts curves.
void ClassifyCurves(const Scene& scene,
                    const std::vector<PosedView>& views,
                    int num_threads,
                    std::vector<Curve>* curves,
                    const StepDone& step_done = {});

}  // namespace curvix
