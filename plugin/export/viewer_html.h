// SPDX-License-Identifier: BSD-3-Clause
// viewer.html: the curves in a browser.
#pragma once

#include <cstddef>
#include <string_view>

#include "plugin/export/curves_json.h"

namespace curvix {

constexpr std::size_t kMaxViewerPoints = 10000;  // of the model

// One page that needs nothing else, with the curves, the cameras and small
// copies of up to 16 well-spread images; those that cannot be read are
// left out. Names of images cannot break out of the page.
void EncodeViewerHtml(const CurveRecord& record,
                      int num_threads,
                      const ByteSink& sink);

// plugin/viewer/viewer.html: "@CURVIX_DATA@" stands for the data.
std::string_view ViewerTemplate();

}  // namespace curvix
