// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/filter_curves.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "base/median.h"
#include "geometry/detected_edge.h"
#include "geometry/pixel_size.h"
#include "model/sample_ranges.h"

namespace curvix {
namespace {

// How far apart along the curve tangents are compared.
constexpr double kStraightnessPx = 10;

double MedianContrast(const Curve& curve,
                      const std::vector<EdgeMap>& edge_maps) {
  std::vector<double> strengths;
  for (const CurveSample& sample : curve.samples) {
    for (const EdgeRef& ref : sample.support) {
      strengths.push_back(static_cast<double>(EdgeOf(ref, edge_maps).strength));
    }
  }
  return MedianOr(0, std::move(strengths));
}

// The mean cosine of the angle between the tangents of each sample and the
// first one `distance` further on; 1 for curves that are shorter, 0 for rings
// that turn back.
double Straightness(const Curve& curve, double distance) {
  double sum = 0;
  int num_compared = 0;
  double along = 0;  // from sample i to sample k
  std::size_t k = 0;
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    for (; along < distance && k + 1 < curve.samples.size(); ++k) {
      along +=
          (curve.samples[k + 1].position - curve.samples[k].position).norm();
    }
    if (along < distance) break;
    sum += curve.samples[i].tangent.dot(curve.samples[k].tangent);
    ++num_compared;
    along -= (curve.samples[i + 1].position - curve.samples[i].position).norm();
  }
  return num_compared == 0 ? 1 : std::max(0.0, sum / num_compared);
}

bool Passes(const CurveQualities& curve, const CurveFilterOptions& options) {
  return curve.length_px >= options.min_length_px &&
         curve.num_views >= options.min_num_views &&
         curve.contrast >= options.min_contrast &&
         curve.straightness >= options.min_straightness &&
         (options.max_sigma_px == 0 || curve.sigma_px <= options.max_sigma_px);
}

// The parts of the curves, in order, that are of these kinds: runs of two or
// more samples.
std::vector<Curve> KeepKinds(std::vector<Curve> curves,
                             const CurveKindSet& kinds) {
  std::vector<Curve> pieces;
  for (Curve& curve : curves) {
    std::vector<bool> kept;
    for (const CurveSample& sample : curve.samples) {
      kept.push_back(sample.kind == CurveKind::kUnknown ||
                     kinds.Has(sample.kind));
    }
    std::ranges::move(KeepRanges(std::move(curve), std::move(kept)),
                      std::back_inserter(pieces));
  }
  return pieces;
}

}  // namespace

CurveQualities Measure(const Curve& curve,
                       const std::vector<PosedView>& views,
                       const std::vector<EdgeMap>& edge_maps) {
  std::vector<double> pixels, num_views, sigmas_px;
  for (const CurveSample& sample : curve.samples) {
    num_views.push_back(static_cast<double>(sample.support.size()));
    const double pixel = PixelSize(sample, views);
    if (!(pixel > 0)) continue;
    pixels.push_back(pixel);
    if (sample.sigma > 0) sigmas_px.push_back(sample.sigma / pixel);
  }
  CurveQualities qualities;
  qualities.num_views = Median(std::move(num_views));
  qualities.contrast = MedianContrast(curve, edge_maps);
  qualities.sigma_px = MedianOr(0, std::move(sigmas_px));
  if (pixels.empty()) return qualities;
  const double pixel = Median(std::move(pixels));
  qualities.length_px = Length(curve) / pixel;
  qualities.straightness = Straightness(curve, kStraightnessPx * pixel);
  return qualities;
}

std::vector<Curve> FilterCurves(std::vector<Curve> curves,
                                const std::vector<PosedView>& views,
                                const std::vector<EdgeMap>& edge_maps,
                                const CurveFilterOptions& options) {
  curves = KeepKinds(std::move(curves), options.kinds);
  std::erase_if(curves, [&](const Curve& curve) {
    return !Passes(Measure(curve, views, edge_maps), options);
  });
  return curves;
}

}  // namespace curvix
