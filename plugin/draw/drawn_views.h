// SPDX-License-Identifier: BSD-3-Clause
// What elevations, plans and sections show, side by side on one sheet: the part
// of space that --slice and --crop name, and the lines that photographs show
// from their side.
#pragma once

#include <curvix/fitting.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstddef>
#include <string>
#include <vector>

#include "base/infinity.h"
#include "drawing/drawing_plane.h"
#include "drawing/sheet.h"
#include "plugin/align/curves_file.h"
#include "plugin/draw/choose_dimensions.h"

namespace curvix {

struct DrawRange {
  double from = -kInfinity;
  double to = kInfinity;
};

// Coordinates of the drawing, and depths.
struct DrawWindow {
  DrawRange depth;
  DrawRange across;
  DrawRange upwards;
};

// Of --slice, "FROM,TO", and --crop, "LEFT,BOTTOM,RIGHT,TOP". Empty, or "all"
// as crop: without limits. kInvalidArgument: they are neither.
Result<DrawWindow> ParseWindow(const std::string& slice,
                               const std::string& crop);

// The parts of `fit` that are in the window, in their order; `fit` itself if
// that is all of it.
std::vector<CurveFit> PartsInWindow(const CurveFit& fit,
                                    const DrawingPlane& plane,
                                    const DrawWindow& window);

enum class SeenFrom {
  kUnknown,  // fewer than three photographs look from there
  kSeen,
  kHidden,  // fewer than one in ten of them show it
};

// Whether photographs show `fit` from where `toward` points: those whose rays
// to it are within 45 degrees of that and that have it in the image. What is
// shown is what supports its samples, of which some are looked at. `scene` is
// in the frame of the samples.
SeenFrom SeenFromSide(const CurveFit& fit,
                      const std::vector<SeenSample>& samples,
                      const Eigen::Vector3d& toward,
                      const Scene& scene);

// The curves without the primitives that photographs from there do not show.
// `curves` has samples.
FittedCurves WithoutHidden(const CurvesFile& curves,
                           const Eigen::Vector3d& toward,
                           const Scene& scene);

// One elevation, plan or section.
struct DrawnView {
  DrawingPlane plane;
  DrawWindow window = {};
  std::vector<SheetCurve> curves = {};
  std::vector<MeasuredDimension> measured = {};  // of whole primitives
  int num_unknown = 0;      // primitives that may be hidden or not
  std::size_t num_far = 0;  // left out, far from the others
};

struct DrawnContent {
  const CurvesFile& curves;
  const Scene& scene;  // in the frame of the curves
  std::string hidden;  // "dashed", "omitted" or "solid"
  bool has_dimensions = false;
  bool leaves_out_far = false;  // what MainBoundsOf does not hold
};

// Fills views that have a plane and a window. Others are put beside the first
// one by moving their origins, as in third-angle projection: above or below it
// if they share its horizontal, else to the side from which they are seen.
void FillViews(const DrawnContent& content, std::vector<DrawnView>* views);

}  // namespace curvix
