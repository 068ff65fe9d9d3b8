// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The exact edges of a solid and of what is painted
// on it, their samples, and who sees them.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "base/gray_image.h"
#include "synthetic/solid.h"
#include "synthetic/surfaces.h"
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
                                        const GrayImage& image);

// Up to `num_per_view` points of the surface that each view finds, in random
// places of its image (given by `seed`), with all views that see them: two at
// least. keep_going: as ParallelForWhile asks it; after false, some are
// missing.
std::vector<ScenePoint> FindPoints(
    const Solid& solid,
    const Camera& camera,
    const std::vector<Rigid3>& poses,
    int num_per_view,
    std::uint64_t seed,
    int num_threads,
    const std::function<bool(std::size_t)>& keep_going);

// Every edge at which two faces of the solid meet at an angle of more than
// about 25 degrees, each once, whole: an edge that others touch stays one
// curve. Faces that continue each other smoothly make no edge. Candidates are
// plane with plane, plane with frustum at right angles to its axis, and plane
// with sphere; other pairs are not looked at. Edges shorter than a hundredth of
// the solid's detail() are left out.
//
// Sheets have edges at their rims alone: creases where they stand on a face or
// touch another sheet, boundaries elsewhere.
std::vector<TrueCurve> CreaseCurves(const Solid& solid);

// The outlines of all patterns, as far as they lie on the surface of the solid;
// kind kMarking. Those shorter than a hundredth of its detail are left out, as
// is the texture.
std::vector<TrueCurve> MarkingCurves(const Solid& solid,
                                     const Surfaces& surfaces);

// Samples every `step` or so along the edges of cast shadows, without shadows
// none. `creases` are the edges of the solid, which cast them together with the
// round bodies. curve_id counts on from `first_id`; kind kMarking; likewise
// without the shortest.
std::vector<TrueSample> SampleShadowEdges(const Solid& solid,
                                          const Surfaces& surfaces,
                                          const std::vector<TrueCurve>& creases,
                                          double step,
                                          int first_id);

}  // namespace curvix
