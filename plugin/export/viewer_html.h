// SPDX-License-Identifier: BSD-3-Clause
// viewer.html: the curves in a browser.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "plugin/export/curves_json.h"

namespace curvix {

constexpr std::size_t kMaxViewerPoints = 10000;  // of the model

// Of so many points, every n-th is shown, from the first on: n.
inline std::size_t ViewerPointStep(std::size_t num_points) {
  return std::max<std::size_t>(
      1, (num_points + kMaxViewerPoints - 1) / kMaxViewerPoints);
}

// One page that needs nothing else, with the curves, the cameras and small
// copies of up to 16 well-spread images; those that cannot be read are
// left out. Names of images cannot break out of the page.
void EncodeViewerHtml(const CurveRecord& record,
                      int num_threads,
                      const ByteSink& sink);

// plugin/viewer/viewer.html: "%CURVIX_DATA%" stands for the data.
std::string_view ViewerTemplate();

}  // namespace curvix
