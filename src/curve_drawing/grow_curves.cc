// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/grow_curves.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/parallel.h"
#include "curve_drawing/keep_significant.h"
#include "edge_sketch/evidence.h"
#include "edge_sketch/sketch_input.h"

namespace curvix {
namespace {

// Curves that grow at the same time, for any number of threads. Those that use
// the same edges grow again, so no result depends on it.
constexpr std::size_t kNumAtOnce = 64;
// A 2D edge shows one curve: a curve claims its edges and so many to either
// side of each.
constexpr int kLinksClaimed = 2;

bool AreFree(const std::vector<EdgeRef>& refs, const UsedEdges& claimed) {
  return std::ranges::none_of(
      refs, [&](const EdgeRef& ref) { return claimed.Contains(ref); });
}

std::vector<GrownCurve> Grow(const std::vector<Edge3d>& seeds,
                             const GrowthInput& input,
                             int num_threads,
                             const StepDone& step_done) {
  UsedEdges claimed(input.edge_maps);
  const std::vector<std::size_t> order = ByFallingEvidence(seeds);
  std::vector<GrownCurve> curves;
  const auto total = static_cast<int>(order.size());
  for (std::size_t begin = 0; begin < order.size(); begin += kNumAtOnce) {
    if (step_done && !step_done(static_cast<int>(begin), total)) break;
    std::vector<Growth> growths(std::min(kNumAtOnce, order.size() - begin));
    const auto grow = [&](std::size_t k) {
      growths[k] = GrowFromSeed(seeds[order[begin + k]], input, claimed);
    };
    ParallelFor(growths.size(), num_threads, grow);
    for (std::size_t k = 0; k < growths.size(); ++k) {
      // One before it may have claimed what it found.
      if (!AreFree(growths[k].found, claimed)) grow(k);
      if (!growths[k].curve) continue;
      for (const CurveSample& sample : growths[k].curve->curve.samples) {
        MarkAlongContours(
            sample.support, input.edge_maps, kLinksClaimed, claimed);
      }
      curves.push_back(*std::move(growths[k].curve));
    }
  }
  return curves;
}

}  // namespace

std::vector<Curve> GrowCurves(const std::vector<Edge3d>& seeds,
                              const GrowthInput& input,
                              int num_threads,
                              const StepDone& step_done) {
  return KeepSignificant(
      Grow(seeds, input, num_threads, step_done), input.indices, input.options);
}

}  // namespace curvix
