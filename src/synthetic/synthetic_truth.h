// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Samples of the exact edges, and who sees them.
#pragma once

#include <vector>

#include "synthetic/render.h"
#include "synthetic/solid.h"
#include "synthetic/synthetic_scene.h"
#include "synthetic/true_curve.h"

namespace curvix {

// Samples at equal steps of about `step` along each curve, both ends included;
// curve_id counts the curves from 0. The view counts are left at 0.
std::vector<TrueSample> SampleCurves(const std::vector<TrueCurve>& curves,
                                     double step);

// What one view shows of a sample.
struct SampleInView {
  bool is_seen = false;  // in the image, and nothing hides it
  bool is_edge = false;  // seen, and its two sides differ in the image
};

// One entry for each sample. `image` is the view's image without noise: sides
// differ if their grey values 1.5 px from the edge do by at least 8.
std::vector<SampleInView> LookAtSamples(const std::vector<TrueSample>& samples,
                                        const Solid& solid,
                                        const Camera& camera,
                                        const Rigid3& cam_from_world,
                                        const RenderedImage& image);

// Up to `num_per_view` points of the surface that each view finds, in random
// places of its image (given by `seed`), with all views that see them: two at
// least.
std::vector<ScenePoint> FindPoints(const Solid& solid,
                                   const Camera& camera,
                                   const std::vector<Rigid3>& poses,
                                   int num_per_view,
                                   std::uint64_t seed,
                                   int num_threads);

}  // namespace curvix
