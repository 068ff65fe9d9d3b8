// SPDX-License-Identifier: BSD-3-Clause
// Photographs with curves, and small ones.
#pragma once

#include <curvix/curve_source.h>
#include <curvix/scene.h>
#include <curvix/status.h>

#include <string>

namespace curvix {

// A JPEG of the view's ideal pinhole image, without distortion, at most
// `max_size_px` wide and high; black where the photograph shows nothing.
// kNotFound or kDataLoss if the photograph cannot be read.
Result<std::string> SmallPinholeJpeg(const View& view,
                                     const Camera& camera,
                                     int max_size_px);

// A PNG of the photograph, faded, with the curves drawn over it in their
// colours where it sees them, hidden ones too. Errors as above.
Result<std::string> OverlayPng(const CurveSource& curves,
                               const View& view,
                               const Camera& camera);

}  // namespace curvix
