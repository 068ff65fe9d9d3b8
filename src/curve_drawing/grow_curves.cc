// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/grow_curves.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/parallel.h"
#include "curve_drawing/claimed_edges.h"
#include "curve_drawing/keep_significant.h"
#include "edge_sketch/evidence.h"

namespace curvix {
namespace {

// Curves that grow at the same time, for any number of threads. Those that use
// the same edges grow again, so no result depends on it.
constexpr std::size_t kNumAtOnce = 64;

std::vector<GrownCurve> Grow(const std::vector<Edge3d>& seeds,
                             const GrowthInput& input,
                             int num_threads) {
  ClaimedEdges claimed(input.indices);
  const std::vector<std::size_t> order = ByFallingEvidence(seeds);
  std::vector<GrownCurve> curves;
  for (std::size_t begin = 0; begin < order.size(); begin += kNumAtOnce) {
    std::vector<Growth> growths(std::min(kNumAtOnce, order.size() - begin));
    const auto grow = [&](std::size_t k) {
      growths[k] = GrowFromSeed(seeds[order[begin + k]], input, claimed);
    };
    ParallelFor(growths.size(), num_threads, grow);
    for (std::size_t k = 0; k < growths.size(); ++k) {
      // One before it may have claimed what it found.
      if (!claimed.AreFree(growths[k].found)) grow(k);
      if (!growths[k].curve) continue;
      for (const CurveSample& sample : growths[k].curve->curve.samples) {
        claimed.Claim(sample.support);
      }
      curves.push_back(*std::move(growths[k].curve));
    }
  }
  return curves;
}

}  // namespace

std::vector<Curve> GrowCurves(const std::vector<Edge3d>& seeds,
                              const GrowthInput& input,
                              int num_threads) {
  return KeepSignificant(
      Grow(seeds, input, num_threads), input.indices, input.options);
}

}  // namespace curvix
