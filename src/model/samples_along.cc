// SPDX-License-Identifier: BSD-3-Clause
#include "model/samples_along.h"

#include <algorithm>
#include <cmath>

namespace curvix {

std::vector<std::size_t> SamplesAlong(const Curve& curve,
                                      double spacing,
                                      std::size_t max_num) {
  std::vector<double> along = {0};
  for (std::size_t i = 1; i < curve.samples.size(); ++i) {
    along.push_back(
        along.back() +
        (curve.samples[i].position - curve.samples[i - 1].position).norm());
  }
  const double length = along.back();
  const auto num = std::min(
      max_num,
      static_cast<std::size_t>(std::max(1.0, std::floor(length / spacing))));
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < num; ++i) {
    const double at =
        length * (static_cast<double>(i) + 0.5) / static_cast<double>(num);
    const auto sample = static_cast<std::size_t>(
        std::lower_bound(along.begin(), along.end() - 1, at) - along.begin());
    if (chosen.empty() || chosen.back() != sample) chosen.push_back(sample);
  }
  return chosen;
}

}  // namespace curvix
