// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/draw_window.h"

#include <string_view>
#include <utility>

#include "base/text_fields.h"
#include "drawing/cut_fit.h"

namespace curvix {
namespace {

// "low, ..., high, ...": `count` numbers of which those of the first half are
// below those of the second. Empty: it is not that.
std::vector<double> ParseBox(std::string_view text, std::size_t count) {
  const std::vector<double> numbers = ParseNumbers(text, count);
  for (std::size_t i = 0; i < numbers.size() / 2; ++i) {
    if (!(numbers[i] < numbers[i + count / 2])) return {};
  }
  return numbers;
}

Status BadOption(const std::string& option,
                 const std::string& text,
                 const std::string& what) {
  return Status::InvalidArgument(option + " is \"" + text + "\"; it takes " +
                                 what);
}

}  // namespace

Result<DrawWindow> ParseWindow(const std::string& slice,
                               const std::string& crop) {
  DrawWindow window;
  if (!slice.empty()) {
    const std::vector<double> box = ParseBox(slice, 2);
    if (box.empty()) {
      return BadOption("--slice",
                       slice,
                       "the lower and the higher depth, as in --slice 0.9,1.1");
    }
    window.depth = {box[0], box[1]};
  }
  if (!crop.empty() && crop != "all") {
    const std::vector<double> box = ParseBox(crop, 4);
    if (box.empty()) {
      return BadOption("--crop",
                       crop,
                       "left, bottom, right and top, in the coordinates of the "
                       "drawing, as in --crop 0,0,2.5,3, or all");
    }
    window.across = {box[0], box[2]};
    window.upwards = {box[1], box[3]};
  }
  return window;
}

std::vector<CurveFit> PartsInWindow(const CurveFit& fit,
                                    const DrawingPlane& plane,
                                    const DrawWindow& window) {
  std::vector<CurveFit> parts = {fit};
  for (const auto& [axis, range] : {std::pair(plane.depth_axis, window.depth),
                                    std::pair(plane.right, window.across),
                                    std::pair(plane.up, window.upwards)}) {
    const double at_0 = axis.dot(plane.origin);
    std::vector<CurveFit> within;
    for (const CurveFit& part : parts) {
      for (CurveFit& piece :
           PartsWithin(part, axis, range.from + at_0, range.to + at_0)) {
        within.push_back(std::move(piece));
      }
    }
    parts = std::move(within);
  }
  return parts;
}

}  // namespace curvix
