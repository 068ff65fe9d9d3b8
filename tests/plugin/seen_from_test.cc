// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/drawn_views.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "gtest/gtest.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// Twelve cameras around the z axis, which look at the origin; image ids from 1,
// the first one on the x axis.
Scene Ring() {
  std::vector<PosedView> views;
  for (int i = 0; i < 12; ++i) {
    const double angle = 6.28318530717958647692 * i / 12;
    views.push_back(LookAt({5 * std::cos(angle), 5 * std::sin(angle), 0},
                           Vector3d::Zero()));
  }
  return ToScene(views);
}

// A line of twenty samples through the origin, in these images.
std::vector<SeenSample> SamplesIn(const std::vector<std::uint32_t>& image_ids) {
  std::vector<SeenSample> samples(20);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].position = {0, 0, 0.01 * static_cast<double>(i)};
    samples[i].image_ids = image_ids;
  }
  return samples;
}

CurveFit AllOf(const std::vector<SeenSample>& samples) {
  CurveFit fit;
  fit.num_samples = samples.size();
  return fit;
}

TEST(SeenFromSide, PhotographsOfThatSideDecide) {
  const Scene scene = Ring();
  const auto samples = SamplesIn({1, 2, 12});  // those about the x axis
  const CurveFit fit = AllOf(samples);
  const auto from = [&](const Vector3d& toward) {
    return SeenFromSide(fit, samples, toward.normalized(), scene);
  };
  EXPECT_EQ(from({1, 0, 0}), SeenFrom::kSeen);
  EXPECT_EQ(from({-1, 0, 0}), SeenFrom::kHidden);
  EXPECT_EQ(from({0, 1, 0}), SeenFrom::kHidden);
  // No photograph looks from above.
  EXPECT_EQ(from({0, 0, 1}), SeenFrom::kUnknown);
}

TEST(SeenFromSide, PhotographsThatLookElsewhereDoNotCount) {
  Scene scene = Ring();
  const auto samples = SamplesIn({1, 2, 12});
  const CurveFit fit = AllOf(samples);
  for (View& view : scene.views) view.cam_from_world.translation.x() += 10;
  EXPECT_EQ(SeenFromSide(fit, samples, {-1, 0, 0}, scene), SeenFrom::kUnknown);
}

TEST(SeenFromSide, OnlySamplesOfTheFitCount) {
  const Scene scene = Ring();
  auto samples = SamplesIn({1, 2, 12});
  for (std::size_t i = 10; i < 20; ++i) samples[i].image_ids = {7};
  CurveFit fit;
  fit.num_samples = 10;
  EXPECT_EQ(SeenFromSide(fit, samples, {-1, 0, 0}, scene), SeenFrom::kHidden);
  fit.first_sample = 10;
  EXPECT_EQ(SeenFromSide(fit, samples, {-1, 0, 0}, scene), SeenFrom::kSeen);
  EXPECT_EQ(SeenFromSide(fit, samples, {1, 0, 0}, scene), SeenFrom::kHidden);
}

TEST(WithoutHidden, LeavesOutWhatTheOtherSideShows) {
  CurvesFile curves;
  curves.samples = {SamplesIn({1, 2, 12}), SamplesIn({6, 7, 8})};
  for (const auto& samples : curves.samples) {
    curves.fitted.curves.push_back({{AllOf(samples)}});
  }
  const FittedCurves shown = WithoutHidden(curves, {1, 0, 0}, Ring());
  ASSERT_EQ(shown.curves.size(), 2u);
  EXPECT_EQ(shown.curves[0].fits.size(), 1u);
  EXPECT_EQ(shown.curves[1].fits.size(), 0u);
  // No photograph looks from above.
  EXPECT_EQ(WithoutHidden(curves, {0, 0, 1}, Ring()).curves[1].fits.size(), 1u);
}

}  // namespace
}  // namespace curvix
