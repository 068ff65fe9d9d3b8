// SPDX-License-Identifier: BSD-3-Clause
// Small curves for the tests of file formats.
#pragma once

#include <curvix/curves.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <gtest/gtest.h>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>

namespace curvix {

// A helix of nine samples, a closed circle of twelve and one segment, with
// support by 0 to 3 of the views of MakeTestScene() per sample.
inline CurveSet MakeTestCurves() {
  CurveSet set;
  Curve helix;
  for (int i = 0; i < 9; ++i) {
    const double t = 0.3 * i;
    CurveSample sample;
    sample.position = {std::cos(t), std::sin(t), 0.1 * t};
    sample.tangent =
        Eigen::Vector3d(-std::sin(t), std::cos(t), 0.1).normalized();
    sample.sigma = 1e-3 / (i + 3);
    for (int v = 0; v < i % 4; ++v) sample.support.push_back({v, 0});
    helix.samples.push_back(sample);
  }
  Curve circle;
  circle.closed = true;
  for (int i = 0; i < 12; ++i) {
    const double t = i * std::acos(-1.0) / 6;
    CurveSample sample;
    sample.position = {std::cos(t) / 3, 2.0, std::sin(t) / 3};
    sample.tangent = {-std::sin(t), 0, std::cos(t)};
    sample.support = {{2, 0}};
    circle.samples.push_back(sample);
  }
  Curve segment;
  segment.samples.resize(2);
  segment.samples[1].position = {1.0 / 3, 0, 0};
  set.curves = {helix, circle, segment};
  return set;
}

// Three views with gaps between their image ids.
inline Scene MakeTestScene() {
  Scene scene;
  scene.cameras.resize(1);
  scene.cameras[0].params = {100, 100, 50, 50};
  scene.views.resize(3);
  scene.views[0].image_id = 7;
  scene.views[1].image_id = 3;
  scene.views[2].image_id = 4000000000u;
  return scene;
}

// The bytes that `encode` gives of `things`, the last of which is the sink.
template <typename Encode, typename... Things>
std::string Encoded(Encode encode, const Things&... things) {
  std::string bytes;
  const auto sink = [&](std::string_view more) { bytes += more; };
  if constexpr (std::is_void_v<decltype(encode(things..., sink))>) {
    encode(things..., sink);
  } else {
    const Status status = encode(things..., sink);
    EXPECT_TRUE(status.ok()) << status.message();
  }
  return bytes;
}

template <typename Encode, typename... Things>
std::string EncodedCurves(Encode encode,
                          const CurveSet& curves,
                          const Things&... things) {
  return Encoded(encode, CurvesInMemory(curves), things...);
}

// Checks that `actual` has the curves of `expected`, positions within
// `tolerance`.
inline void ExpectSameGeometry(const CurveSet& actual,
                               const CurveSet& expected,
                               double tolerance,
                               double tangent_tolerance) {
  ASSERT_EQ(actual.curves.size(), expected.curves.size());
  for (std::size_t c = 0; c < expected.curves.size(); ++c) {
    const Curve& a = actual.curves[c];
    const Curve& b = expected.curves[c];
    EXPECT_EQ(a.closed, b.closed) << "curve " << c;
    ASSERT_EQ(a.samples.size(), b.samples.size()) << "curve " << c;
    for (std::size_t i = 0; i < b.samples.size(); ++i) {
      const CurveSample& s = a.samples[i];
      EXPECT_LE((s.position - b.samples[i].position).norm(), tolerance);
      EXPECT_LE((s.tangent - b.samples[i].tangent).norm(), tangent_tolerance);
    }
  }
}

}  // namespace curvix
