// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <utility>

#include "geometry/pixel_size.h"

namespace curvix {

std::vector<Curve> RefineCurves(const std::vector<Curve>& curves,
                                const RefinementInput& input) {
  const CurveRefinementOptions& options = input.options;
  if (!options.enabled) return curves;
  const ImageSupport images(input.views, input.edge_maps, input.num_threads);
  if (input.Stops()) return {};
  SelectedCurves selected = SelectCurves(curves, input, images);
  if (input.Stops()) return {};
  std::vector<Curve> refined = SmoothCurves(selected.edges, input);
  if (input.Stops()) return {};
  if (options.separate_touching) {
    refined = SeparateTouching(std::move(refined), input, images);
  }
  if (input.Stops()) return {};
  refined = BridgeGaps(std::move(refined), input, images);
  if (input.Stops()) return {};
  const ResponseCurve response = options.undo_response_curve
                                     ? EstimateResponseCurve(refined, input)
                                     : ResponseCurve();
  refined = FitToImages(std::move(refined), input, response);
  if (input.Stops()) return {};
  refined = FlattenCurves(std::move(refined), input, response);
  if (input.Stops()) return {};
  if (options.separate_touching) {
    refined = CutAtTouches(std::move(refined), input);
  }
  refined = CutCorners(refined, input);
  if (input.Stops()) return {};
  refined = MeetAtJunctions(std::move(refined), input);
  refined = DropLooseShortCurves(
      std::move(refined), input.views, options.min_length_px);
  if (options.keep_occluding_contours) {
    for (Curve& contour : SmoothCurves(selected.occluding_contours, input)) {
      refined.push_back(std::move(contour));
    }
  }
  return EstimateCovariances(std::move(refined), input, response);
}

}  // namespace curvix
