// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "model/curve_junctions.h"

#include <algorithm>
#include <array>
#include <map>

namespace curvix {
namespace {

using Place = std::array<double, 3>;

Place PlaceOf(const CurveSample& sample) {
  return {sample.position.x(), sample.position.y(), sample.position.z()};
}

}  // namespace

void IndexJunctions(CurveSet& curves) {
  std::map<Place, int> num_ends;
  for (const Curve& curve : curves.curves) {
    if (curve.closed || curve.samples.empty()) continue;
    ++num_ends[PlaceOf(curve.samples.front())];
    ++num_ends[PlaceOf(curve.samples.back())];
  }
  curves.junctions.clear();
  std::map<Place, int> index_of;
  const auto junction_at = [&](const CurveSample& sample) {
    const Place place = PlaceOf(sample);
    if (num_ends[place] < 2) return -1;
    const auto [found, is_new] =
        index_of.try_emplace(place, static_cast<int>(curves.junctions.size()));
    if (is_new) {
      curves.junctions.push_back(
          {sample.position, sample.sigma, num_ends[place]});
    }
    CurveJunction& junction =
        curves.junctions[static_cast<std::size_t>(found->second)];
    junction.sigma = std::max(junction.sigma, sample.sigma);
    return found->second;
  };
  for (Curve& curve : curves.curves) {
    curve.start_junction = curve.end_junction = -1;
    if (curve.closed || curve.samples.empty()) continue;
    curve.start_junction = junction_at(curve.samples.front());
    curve.end_junction = junction_at(curve.samples.back());
  }
}

}  // namespace curvix
