// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <cstddef>
#include <string>

#include "io/curve_formats.h"
#include "io/curve_style.h"
#include "tests/io/test_curves.h"

namespace curvix {
namespace {

double SrgbFromLinear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear
                             : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// Colours are at the end, four bytes per sample, curve after curve.
TEST(EncodeGlbCurves, ScreensShowTheColoursOfTheCurves) {
  const CurveSet set = MakeTestCurves();
  const std::string glb = EncodedCurves(EncodeGlbCurves, set);
  std::size_t num_samples = 0;
  for (const Curve& curve : set.curves) num_samples += curve.samples.size();
  ASSERT_GT(glb.size(), 4 * num_samples);
  std::size_t at = glb.size() - 4 * num_samples;
  const auto byte = [&](std::size_t i) {
    return static_cast<unsigned char>(glb[i]);
  };
  for (std::size_t id = 0; id < set.curves.size(); ++id) {
    for (std::size_t i = 0; i < set.curves[id].samples.size(); ++i, at += 4) {
      for (std::size_t c = 0; c < 3; ++c) {
        // Linear bytes are coarser where it is dark: up to seven of sRGB.
        EXPECT_NEAR(
            255 * SrgbFromLinear(byte(at + c) / 255.0), CurveColor(id)[c], 7);
      }
      EXPECT_EQ(byte(at + 3), 255);
    }
  }
}

}  // namespace
}  // namespace curvix
