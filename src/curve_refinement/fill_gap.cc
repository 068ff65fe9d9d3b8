// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves where edges are missing.
#include "curve_refinement/curve_ends.h"

#include <utility>

#include "base/median.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

constexpr double kSpacingPx = 1.5;
constexpr double kMinSupportShare = 0.5;    // of the usual support
constexpr double kMinSupportedShare = 0.8;  // of the samples
constexpr std::size_t kNumEndSamples = 10;

std::vector<CurveSample> SamplesBetween(const CurveSample& from,
                                        const CurveSample& to,
                                        double pixel,
                                        const ImageSupport& images) {
  const double gap = (to.position - from.position).norm();
  const int num_pieces = static_cast<int>(gap / (kSpacingPx * pixel)) + 1;
  std::vector<CurveSample> filled;
  for (int k = 1; k < num_pieces; ++k) {
    const double u = static_cast<double>(k) / num_pieces;
    const double v = 1 - u;
    CurveSample& sample = filled.emplace_back();
    sample.position = (1 + 2 * u) * v * v * from.position +
                      (1 + 2 * v) * u * u * to.position +
                      gap * u * v * (v * from.tangent - u * to.tangent);
    sample.tangent = (v * from.tangent + u * to.tangent).normalized();
    sample.sigma = std::max(from.sigma, to.sigma);
    sample.evidence = std::min(from.evidence, to.evidence);
    sample.support = images.Find({sample.position, sample.tangent});
  }
  return filled;
}

}  // namespace

std::vector<Curve> StringTogetherFilled(std::vector<Curve> curves,
                                        const EndTies& ties,
                                        const ImageSupport& images) {
  return StringTogether(std::move(curves),
                        ties,
                        [&](const CurveSample& from, const CurveSample& to) {
                          const double pixel = PixelSize(from, images.views());
                          return SamplesBetween(from, to, pixel, images);
                        });
}

double SupportBefore(const Curve& curve, bool at_head) {
  std::vector<double> counts;
  for (std::size_t k = 0; k < std::min(kNumEndSamples, curve.samples.size());
       ++k) {
    const CurveSample& sample = SampleFromEnd(curve, at_head, k);
    if (sample.support.empty()) continue;
    counts.push_back(static_cast<double>(sample.support.size()));
  }
  return MedianOr(0, std::move(counts));
}

bool IsGapShown(const CurveSample& from,
                const CurveSample& to,
                double pixel,
                double usual,
                const ImageSupport& images) {
  const std::vector<CurveSample> filled =
      SamplesBetween(from, to, pixel, images);
  const double least = std::max(1.0, kMinSupportShare * usual);
  const auto num_shown = std::ranges::count_if(filled, [&](const auto& sample) {
    return static_cast<double>(sample.support.size()) >= least;
  });
  return static_cast<double>(num_shown) >=
         kMinSupportedShare * static_cast<double>(filled.size());
}

}  // namespace curvix
