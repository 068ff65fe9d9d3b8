// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "refinement/samples_around.h"

namespace curvix {
namespace {

void Walk(const Curve& curve,
          int direction,
          double reach,
          std::vector<SampleAround>& around) {
  const std::size_t size = curve.samples.size();
  const std::size_t last = direction > 0 ? size - 1 : 0;
  std::size_t steps = curve.closed ? (size - 1) / 2 : size;
  double along = 0;
  for (std::size_t here = around.front().index; steps > 0; --steps) {
    if (!curve.closed && here == last) return;
    const std::size_t next =
        direction > 0 ? (here + 1) % size : (here + size - 1) % size;
    along +=
        (curve.samples[next].position - curve.samples[here].position).norm();
    if (along > reach) return;
    around.push_back({next, direction * along});
    here = next;
  }
}

}  // namespace

std::vector<SampleAround> SamplesAround(const Curve& curve,
                                        std::size_t index,
                                        double reach) {
  std::vector<SampleAround> around = {{index, 0}};
  Walk(curve, 1, reach, around);
  Walk(curve, -1, reach, around);
  return around;
}

}  // namespace curvix
