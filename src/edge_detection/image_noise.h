// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). How noisy an image is.
#pragma once

#include "edge_detection/gray_image.h"

namespace curvix {

// The standard deviation of the image noise, in grey levels; 0 where there is
// none, or where it cannot be told: images below 3 x 3 pixels or clipped (black
// or white) everywhere. A robust form of Immerkaer (1996): the median size of
// the response to the mask (1 -2 1)^T (1 -2 1), which ignores planes of grey,
// over the flattest quarter of the pixels that are not clipped. Flatness is
// judged by Sobel's gradient, which in white noise is independent of that mask,
// so that the choice does not bias the estimate. The noise of 8-bit rounding,
// 1 / 12 of a squared grey level, is taken off.
double EstimateNoise(const GrayImage& image);

}  // namespace curvix
