// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). How noisy an image is.
#pragma once

#include "base/gray_image.h"

namespace curvix {

// The standard deviation of the image noise in grey levels, as the edge filters
// see it. 0 without noise, and where it cannot be estimated: images below 5 x 5
// pixels, or clipped (black or white) everywhere.
//
// A robust form of Immerkaer's (1996) method at the scale of the edge filters:
// the median size of the Laplacian of the image smoothed by about 1 px, over
// the flatter half of the pixels that are not clipped. Finer masks would not
// do, since JPEG removes the finest noise and leaves what edges are made of.
// Flatness is decided by the gradient of the same smoothed image, which in
// stationary noise is independent of the Laplacian at the same place, so that
// the choice does not bias the estimate. Smooth shading has no Laplacian;
// texture finer than a few pixels counts as noise where it covers most of the
// image. The noise of 8-bit rounding, 1/12 of a squared grey level, is taken
// off.
double EstimateNoise(const GrayImage& image);

}  // namespace curvix
