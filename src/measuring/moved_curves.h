// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves and scenes in another frame.
#pragma once

#include <curvix/curves.h>
#include <curvix/fitting.h>
#include <curvix/scene.h>
#include <cstddef>

#include "geometry/similarity.h"

namespace curvix {

// Positions, directions, lengths, sigmas and covariances in b. Equal positions
// stay equal to the last bit.
Curve MoveCurve(const Similarity3& b_from_a, Curve curve);
FittedCurves MoveFits(const Similarity3& b_from_a, FittedCurves fitted);
// Poses and points; images see the same.
Scene MoveScene(const Similarity3& b_from_a, Scene scene);

// The curves of a source, which outlives this, in b.
class MovedCurves : public CurveSource {
 public:
  MovedCurves(const CurveSource& curves, const Similarity3& b_from_a)
      : curves_(curves), b_from_a_(b_from_a) {}

  std::size_t size() const override { return curves_.size(); }
  void ForEach(const Visit& visit) const override {
    curves_.ForEach([&](std::size_t id, const Curve& curve) {
      visit(id, MoveCurve(b_from_a_, curve));
    });
  }
  Status status() const override { return curves_.status(); }
  Edge2d EdgeOf(const EdgeRef& ref) const override {
    return curves_.EdgeOf(ref);
  }

 private:
  const CurveSource& curves_;
  Similarity3 b_from_a_;
};

}  // namespace curvix
