// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Layers of drawings: one for each kind of curve.
#pragma once

#include <curvix/curves.h>
#include <array>
#include <cstddef>

namespace curvix {

struct DrawingLayer {
  const char* name;
  int color;     // AutoCAD's index
  double width;  // of its lines on paper, mm
};

// In the order of CurveKind. Outlines are broadest, markings narrowest.
constexpr std::array<DrawingLayer, kNumCurveKinds> kDrawingLayers = {
    {{"UNKNOWN", 3, 0.25},
     {"CREASES", 7, 0.35},
     {"BOUNDARIES", 5, 0.5},
     {"MARKINGS", 8, 0.18},
     {"OCCLUDING_CONTOURS", 6, 0.5}}};

inline const DrawingLayer& LayerOf(CurveKind kind) {
  return kDrawingLayers[static_cast<std::size_t>(kind)];
}

}  // namespace curvix
