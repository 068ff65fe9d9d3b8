// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <utility>

#include "geometry/pixel_size.h"

namespace curvix {

std::vector<Curve> RefineCurves(const std::vector<Curve>& curves,
                                const RefinementInput& input) {
  const auto& [views, edge_maps, edge_sigma_px, options, num_threads, _] =
      input;
  if (!options.enabled) return curves;
  const ImageSupport images(views, edge_maps, num_threads);
  if (input.Stops()) return {};
  SelectedCurves selected = SelectCurves(curves, input, images);
  if (input.Stops()) return {};
  std::vector<Curve> refined =
      SmoothCurves(selected.edges, views, options, num_threads);
  if (input.Stops()) return {};
  if (options.separate_touching) {
    refined = SeparateTouching(std::move(refined), views, images, num_threads);
  }
  if (input.Stops()) return {};
  refined = BridgeGaps(std::move(refined), views, images, options, num_threads);
  if (input.Stops()) return {};
  const ResponseCurve response = options.undo_response_curve
                                     ? EstimateResponseCurve(refined, input)
                                     : ResponseCurve();
  refined = FitToImages(std::move(refined), input, response);
  if (input.Stops()) return {};
  refined = FlattenCurves(std::move(refined), input, response);
  if (input.Stops()) return {};
  if (options.separate_touching) {
    refined = CutAtTouches(std::move(refined), views);
  }
  refined = CutCorners(refined, views, options, num_threads);
  if (input.Stops()) return {};
  refined = MeetAtJunctions(std::move(refined), views, options, num_threads);
  refined =
      DropLooseShortCurves(std::move(refined), views, options.min_length_px);
  if (options.keep_occluding_contours) {
    for (Curve& contour : SmoothCurves(
             selected.occluding_contours, views, options, num_threads)) {
      refined.push_back(std::move(contour));
    }
  }
  return EstimateCovariances(std::move(refined), input, response);
}

}  // namespace curvix
